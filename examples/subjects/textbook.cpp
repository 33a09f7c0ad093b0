// A textbook Kalman filter in C++17 (standard library only) as a subject:
//     c++ -O2 -o textbook textbook.cpp && exact-kalman check -- ./textbook
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

// --- Reading: a value of JSON. A string keeps its escapes as they stand, so an id is echoed letter by letter.
struct Json {
    enum Kind { null, string, list, object } kind = null;
    std::string text;
    std::vector<Json> items;
    std::map<std::string, Json> fields;
    const Json *field(const std::string &name) const {
        auto found = fields.find(name);
        return found == fields.end() ? nullptr : &found->second;
    }
    int depth() const {
        int deepest = 0;
        for (const Json &item : items) deepest = std::max(deepest, item.depth());
        return kind == list ? 1 + deepest : 0;
    }
};

Json read(const char *&at) {
    auto skip = [&](const char *passed) { while (*at && std::string(passed).find(*at) != std::string::npos) ++at; };
    Json value;
    skip(" ,:");
    if (*at == '"') {
        value.kind = Json::string;
        const char *begin = ++at;
        while (*at && *at != '"') at += *at == '\\' && at[1] ? 2 : 1;
        value.text.assign(begin, at);
        if (*at) ++at;
    } else if (*at == '[' || *at == '{') {
        value.kind = *at == '[' ? Json::list : Json::object;
        ++at;
        for (skip(" ,"); *at && *at != ']' && *at != '}'; skip(" ,")) {
            if (value.kind == Json::list) value.items.push_back(read(at));
            else { std::string key = read(at).text; value.fields[key] = read(at); }
        }
        if (*at) ++at;
    } else {
        while (*at && !std::strchr(",]} ", *at)) value.text += *at++;  // null, true, false
    }
    return value;
}

// --- Matrices.
struct Matrix {
    size_t rows, columns;
    std::vector<double> entries;
    Matrix(size_t r, size_t c) : rows(r), columns(c), entries(r * c) {}
    // With bounds: what does not fit together is an error, and not undefined.
    double &operator()(size_t i, size_t j) { return entries.at(i * columns + j); }
    double operator()(size_t i, size_t j) const { return entries.at(i * columns + j); }
};

Matrix filled(size_t rows, size_t columns, const std::function<double(size_t, size_t)> &entry) {
    Matrix m(rows, columns);
    for (size_t i = 0; i < rows; ++i) for (size_t j = 0; j < columns; ++j) m(i, j) = entry(i, j);
    return m;
}
Matrix operator*(const Matrix &a, const Matrix &b) {
    return filled(a.rows, b.columns, [&](size_t i, size_t j) {
        double sum = 0;
        for (size_t l = 0; l < a.columns; ++l) sum += a(i, l) * b(l, j);
        return sum;
    });
}
Matrix operator+(const Matrix &a, const Matrix &b) { return filled(a.rows, a.columns, [&](size_t i, size_t j) { return a(i, j) + b(i, j); }); }
Matrix operator-(const Matrix &a, const Matrix &b) { return filled(a.rows, a.columns, [&](size_t i, size_t j) { return a(i, j) - b(i, j); }); }
Matrix t(const Matrix &a) { return filled(a.columns, a.rows, [&](size_t i, size_t j) { return a(j, i); }); }
Matrix symmetric(const Matrix &a) { return filled(a.rows, a.rows, [&](size_t i, size_t j) { return (a(i, j) + a(j, i)) / 2; }); }
Matrix rows_of(const Matrix &a, const std::vector<size_t> &kept) { return filled(kept.size(), a.columns, [&](size_t i, size_t j) { return a(kept[i], j); }); }

// B A⁻¹ for symmetric A, by Gaussian elimination with row exchanges.
Matrix over(const Matrix &b, Matrix a) {
    Matrix x = t(b);
    size_t n = a.rows;
    for (size_t k = 0; k < n; ++k) {
        size_t pivot = k;
        for (size_t i = k; i < n; ++i) if (std::fabs(a(i, k)) > std::fabs(a(pivot, k))) pivot = i;
        if (a(pivot, k) == 0) throw std::runtime_error("the innovation covariance is singular");
        for (Matrix *m : {&a, &x}) for (size_t j = 0; j < m->columns; ++j) std::swap((*m)(k, j), (*m)(pivot, j));
        for (size_t i = 0; i < n; ++i) {
            double factor = a(i, k) / a(k, k);
            if (i != k) for (Matrix *m : {&a, &x}) for (size_t j = 0; j < m->columns; ++j) (*m)(i, j) -= factor * (*m)(k, j);
        }
    }
    return t(filled(n, x.columns, [&](size_t i, size_t j) { return x(i, j) / a(i, i); }));
}

// --- The case. strtod reads decimals and hexadecimal floats to the nearest double.
double number(const Json &text) { return std::strtod(text.text.c_str(), nullptr); }

// The matrix (deep = 2) or column (deep = 1) at k of a constant, or of a list with one value per observation.
Matrix at(const Json &value, int deep, size_t k) {
    bool per_step = value.depth() > deep;
    for (const Json &item : value.items) per_step = per_step || item.kind == Json::null;
    const Json &m = per_step ? value.items.at(k) : value;
    if (deep == 1) return filled(m.items.size(), 1, [&](size_t i, size_t) { return number(m.items[i]); });
    return filled(m.items.size(), m.items.empty() ? 0 : m.items[0].items.size(), [&](size_t i, size_t j) { return number(m.items[i].items.at(j)); });
}

// B u.
Matrix added(const Json &c, const char *name, size_t size, size_t k) {
    const Json *term = c.field(name);
    if (!term) return Matrix(size, 1);
    Matrix vector = at(*term->field("vector"), 1, k);
    return term->field("matrix") ? at(*term->field("matrix"), 2, k) * vector : vector;
}

std::string text(const Matrix &m, bool is_vector) {
    std::string out = "[";
    char buffer[40];
    for (size_t i = 0; i < m.rows; ++i) {
        out += i ? "," : "";
        out += is_vector ? "" : "[";
        for (size_t j = 0; j < m.columns; ++j) {
            std::snprintf(buffer, sizeof buffer, "%s\"%.17g\"", j ? "," : "", m(i, j));
            out += buffer;
        }
        out += is_vector ? "" : "]";
    }
    return out + "]";
}
std::string laws(const std::string &when, const Matrix &x, const Matrix &p) {
    return "\"" + when + "_mean\":" + text(x, true) + ",\"" + when + "_covariance\":" + text(p, false);
}

// --- The filter. Steps are appended as they are found, so that what comes before an error is not lost.
void filter(const Json &c, std::vector<std::string> &done) {
    const Json &readings = *c.field("observations"), &initial = *c.field("initial"), &noise = *c.field("noise");
    bool arriving = c.field("timing")->text == "arriving";
    Matrix x = at(*initial.field("mean"), 1, 0), p = at(*initial.field("covariance"), 2, 0);
    size_t n = x.rows, m = at(*c.field("observation"), 2, 0).rows, count = readings.items.size();
    bool factors = noise.field("process_factor");
    for (size_t k = 0; k < count; ++k) {
        bool leads_here = arriving && (k > 0 || initial.field("before")->text == "transition");
        bool leaves = !arriving && k + 1 < count, moves = leads_here || leaves;
        auto given = [&](const char *name) { return at(*noise.field(name), 2, k); };
        Matrix a(n, n), u(n, 1), q(n, n), s(n, m), r(m, m);
        if (factors) { Matrix f = given("observation_factor"); r = f * t(f); } else r = given("observation");
        if (moves) {  // no observation depends on the other transitions
            a = at(*c.field("transition"), 2, k), u = added(c, "input", n, k);
            if (factors) { Matrix d = given("process_factor"); q = d * t(d), s = d * t(given("observation_factor")); }
            else { q = given("process"); if (noise.field("cross")) s = given("cross"); }
        }
        if (leads_here) x = a * x + u, p = symmetric(a * p * t(a) + q);
        std::string step = "{" + laws("predicted", x, p);
        std::vector<size_t> seen;
        const Json &reading = readings.items[k];
        for (size_t i = 0; i < reading.items.size(); ++i) if (reading.items[i].kind != Json::null) seen.push_back(i);
        s = t(rows_of(t(s), seen));
        Matrix h = rows_of(at(*c.field("observation"), 2, k), seen);
        Matrix shared = leads_here ? s : Matrix(n, seen.size());  // cov(x_k, noise of y_k)
        Matrix cov = p * t(h) + shared;
        Matrix var = h * cov + t(rows_of(t(rows_of(r, seen)), seen)) + t(h * shared);
        Matrix e = filled(seen.size(), 1, [&](size_t i, size_t) { return number(reading.items[seen[i]]); });
        e = e - h * x - rows_of(added(c, "observation_input", m, k), seen);
        Matrix gain = over(cov, var);
        x = x + gain * e, p = symmetric(p - gain * t(cov));
        done.push_back(step + "," + laws("filtered", x, p) + "}");
        if (leaves) {  // y_k tells about the noise of the transition that follows
            Matrix weight = over(s, var), mixed = a * gain * t(s);
            x = a * x + u + weight * e;
            p = symmetric(a * p * t(a) + q - mixed - t(mixed) - weight * t(s));
        }
    }
}

int main() {
    std::cout << R"({"format":"exact-kalman/subject/1","name":"textbook, C++","unsupported":["diffuse"]})" << std::endl;
    for (std::string line; std::getline(std::cin, line);) {
        const char *at = line.c_str();
        Json c = read(at);
        std::vector<std::string> done;
        std::string outcome = "\"answered\"";
        if (c.field("numbers")->text != "binary64") outcome = "\"unsupported\"";
        else try { filter(c, done); } catch (const std::exception &reason) {
            outcome = "\"error\",\"step\":" + std::to_string(done.size()) + ",\"message\":\"" + reason.what() + "\"";
        }
        std::cout << "{\"id\":\"" << c.field("id")->text << "\",\"outcome\":" << outcome << ",\"steps\":[";
        for (size_t k = 0; k < done.size(); ++k) std::cout << (k ? "," : "") << done[k];
        std::cout << "]}" << std::endl;
    }
}
