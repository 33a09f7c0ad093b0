//! A textbook Kalman filter in Rust (standard library only) as a subject:
//!
//!     rustc -O textbook.rs && exact-kalman check -- ./textbook

use std::collections::BTreeMap;
use std::io::{BufRead, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

// --- Reading: a value of JSON. A string keeps its escapes as they stand, so an id is echoed letter by letter.
#[derive(Clone, Debug)]
enum Json {
    Null,
    Text(String),
    List(Vec<Json>),
    Object(BTreeMap<String, Json>),
}

impl Json {
    /// Reads one value, commas and colons before it passed over; nothing at the end of a list or of the line.
    fn read(bytes: &[u8], at: &mut usize) -> Option<Self> {
        while matches!(bytes.get(*at), Some(b' ' | b',' | b':')) {
            *at += 1;
        }
        let first = *bytes.get(*at)?;
        *at += 1;
        let begin = *at;
        match first {
            b']' | b'}' => None,
            b'[' => Some(Self::List(std::iter::from_fn(|| Self::read(bytes, at)).collect())),
            b'{' => {
                let mut fields = BTreeMap::new();
                while let Some(Self::Text(key)) = Self::read(bytes, at) {
                    fields.insert(key, Self::read(bytes, at)?);
                }
                Some(Self::Object(fields))
            }
            b'"' => {
                while *bytes.get(*at)? != b'"' {
                    *at += if bytes[*at] == b'\\' { 2 } else { 1 };
                }
                *at += 1;
                Some(Self::Text(String::from_utf8_lossy(&bytes[begin..*at - 1]).into_owned()))
            }
            _ => {
                while bytes.get(*at).is_some_and(u8::is_ascii_alphanumeric) {
                    *at += 1;
                }
                Some(Self::Null) // null, true, false
            }
        }
    }

    fn field(&self, name: &str) -> Option<&Self> {
        if let Self::Object(fields) = self { fields.get(name) } else { None }
    }

    fn need(&self, name: &str) -> Result<&Self, String> {
        self.field(name).ok_or_else(|| format!("no {name}"))
    }

    fn text(&self) -> &str {
        if let Self::Text(text) = self { text } else { "" }
    }

    fn items(&self) -> &[Self] {
        if let Self::List(items) = self { items } else { &[] }
    }

    fn is_null(&self) -> bool {
        matches!(self, Self::Null)
    }

    fn depth(&self) -> usize {
        if let Self::List(items) = self { 1 + items.iter().map(Self::depth).max().unwrap_or(0) } else { 0 }
    }

    /// A decimal: the nearest double, as `parse` gives it.
    fn number(&self) -> Result<f64, String> {
        if self.text().contains(['x', 'X']) {
            return Err(HEXADECIMAL.into());
        }
        self.text().parse().map_err(|_| format!("{:?} is no decimal", self.text()))
    }

    /// The matrix (deep = 2) or column (deep = 1) at k of a constant, or of a list with one value per observation.
    fn at(&self, deep: usize, k: usize) -> Result<Matrix, String> {
        let per_step = self.depth() > deep || self.items().iter().any(Self::is_null);
        let value = if per_step { self.items().get(k).ok_or("a list is too short")? } else { self };
        let rows: Result<Vec<Vec<f64>>, String> = match deep {
            1 => value.items().iter().map(|entry| Ok(vec![entry.number()?])).collect(),
            _ => value.items().iter().map(|row| row.items().iter().map(Self::number).collect()).collect(),
        };
        let rows = rows?;
        if rows.iter().any(|row| row.len() != rows[0].len()) {
            return Err("the rows of a matrix differ in length".into());
        }
        Ok(Matrix(rows))
    }
}

const HEXADECIMAL: &str = "hexadecimal floats are not read";

// --- Matrices, by rows.
#[derive(Clone)]
struct Matrix(Vec<Vec<f64>>);

impl Matrix {
    fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        Self((0..rows).map(|i| (0..columns).map(|j| entry(i, j)).collect()).collect())
    }
    fn zero(rows: usize, columns: usize) -> Self {
        Self::new(rows, columns, |_, _| 0.0)
    }
    fn size(&self) -> (usize, usize) {
        (self.0.len(), self.0.first().map_or(0, Vec::len))
    }
    fn t(&self) -> Self {
        Self::new(self.size().1, self.size().0, |i, j| self.0[j][i])
    }
    fn times(&self, b: &Self) -> Self {
        assert_eq!(self.size().1, b.size().0, "matrices do not fit");
        let entry = |i: usize, j: usize| self.0[i].iter().zip(&b.0).map(|(x, row)| x * row[j]).sum();
        Self::new(self.0.len(), b.size().1, entry)
    }
    fn plus(&self, b: &Self) -> Self {
        assert_eq!(self.size(), b.size(), "matrices do not fit");
        Self::new(self.size().0, self.size().1, |i, j| self.0[i][j] + b.0[i][j])
    }
    fn minus(&self, b: &Self) -> Self {
        assert_eq!(self.size(), b.size(), "matrices do not fit");
        Self::new(self.size().0, self.size().1, |i, j| self.0[i][j] - b.0[i][j])
    }
    fn symmetric(&self) -> Self {
        Self::new(self.0.len(), self.0.len(), |i, j| (self.0[i][j] + self.0[j][i]) / 2.0)
    }
    fn rows(&self, kept: &[usize]) -> Self {
        Self(kept.iter().map(|&i| self.0[i].clone()).collect())
    }
    fn columns(&self, kept: &[usize]) -> Self {
        Self(self.0.iter().map(|row| kept.iter().map(|&j| row[j]).collect()).collect())
    }
    /// The congruence A P Aᵀ.
    fn around(&self, p: &Self) -> Self {
        self.times(p).times(&self.t())
    }
    /// self · A⁻¹ for symmetric A, by Gaussian elimination with row exchanges.
    fn over(&self, a: &Self) -> Result<Self, String> {
        let n = a.0.len();
        let mut rows: Vec<Vec<f64>> = (0..n).map(|i| [&a.0[i][..], &self.t().0[i]].concat()).collect();
        for k in 0..n {
            let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).unwrap_or(k);
            rows.swap(k, pivot);
            if rows[k][k] == 0.0 {
                return Err("the innovation covariance is singular".into());
            }
            let row = rows[k].clone();
            for other in (0..n).filter(|&i| i != k) {
                let factor = rows[other][k] / row[k];
                rows[other].iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            }
        }
        Ok(Self::new(self.0.len(), n, |i, j| rows[j][n + i] / rows[j][j]))
    }
    fn text(&self) -> String {
        let row =
            |row: &Vec<f64>| format!("[{}]", row.iter().map(|x| format!("\"{x:e}\"")).collect::<Vec<_>>().join(","));
        format!("[{}]", self.0.iter().map(row).collect::<Vec<_>>().join(","))
    }
}

fn laws(when: &str, x: &Matrix, p: &Matrix) -> String {
    let mean = x.t().text();
    format!(r#""{when}_mean":{},"{when}_covariance":{}"#, &mean[1..mean.len() - 1], p.text())
}

// --- The filter. Steps are appended as they are found, so that what comes before an error is not lost.

/// B u.
fn added(case: &Json, name: &str, size: usize, k: usize) -> Result<Matrix, String> {
    let Some(term) = case.field(name) else { return Ok(Matrix::zero(size, 1)) };
    let vector = term.need("vector")?.at(1, k)?;
    term.field("matrix").map_or(Ok(vector.clone()), |matrix| Ok(matrix.at(2, k)?.times(&vector)))
}

/// Q, cov(process noise, observation noise) and R; the first two are zero where nothing moves.
fn law(noise: &Json, n: usize, m: usize, k: usize, moves: bool) -> Result<[Matrix; 3], String> {
    let given = |name: &str| noise.need(name)?.at(2, k);
    let (mut q, mut s) = (Matrix::zero(n, n), Matrix::zero(n, m));
    if noise.field("process_factor").is_some() {
        let f = given("observation_factor")?;
        if moves {
            let d = given("process_factor")?;
            (q, s) = (d.times(&d.t()), d.times(&f.t()));
        }
        return Ok([q, s, f.times(&f.t())]);
    }
    if moves {
        q = given("process")?;
        s = if noise.field("cross").is_some() { given("cross")? } else { s };
    }
    Ok([q, s, given("observation")?])
}

fn filter(case: &Json, done: &mut Vec<String>) -> Result<(), String> {
    let (initial, readings) = (case.need("initial")?, case.need("observations")?.items());
    let arriving = case.need("timing")?.text() == "arriving";
    let (mut x, mut p) = (initial.need("mean")?.at(1, 0)?, initial.need("covariance")?.at(2, 0)?);
    let observation = case.need("observation")?;
    let (n, m) = (x.size().0, observation.at(2, 0)?.size().0);
    for (k, reading) in readings.iter().enumerate() {
        let leads_here = arriving && (k > 0 || initial.need("before")?.text() == "transition");
        let leaves = !arriving && k + 1 < readings.len();
        let [q, s, r] = law(case.need("noise")?, n, m, k, leads_here || leaves)?;
        let (mut a, mut u) = (Matrix::zero(n, n), Matrix::zero(n, 1));
        if leads_here || leaves {
            (a, u) = (case.need("transition")?.at(2, k)?, added(case, "input", n, k)?);
        }
        if leads_here {
            (x, p) = (a.times(&x).plus(&u), a.around(&p).plus(&q).symmetric());
        }
        let step = laws("predicted", &x, &p);
        let seen: Vec<usize> = (0..reading.items().len()).filter(|&i| !reading.items()[i].is_null()).collect();
        let (mut e, mut gain, mut var) = (Matrix::zero(0, 1), Matrix::zero(n, 0), Matrix::zero(0, 0));
        if !seen.is_empty() {
            let h = observation.at(2, k)?.rows(&seen);
            // cov(x_k, noise of y_k)
            let shared = if leads_here { s.columns(&seen) } else { Matrix::zero(n, seen.len()) };
            let cov = p.times(&h.t()).plus(&shared);
            var = h.times(&cov).plus(&r.rows(&seen).columns(&seen)).plus(&h.times(&shared).t());
            let y: Result<Vec<Vec<f64>>, String> =
                seen.iter().map(|&i| Ok(vec![reading.items()[i].number()?])).collect();
            e = Matrix(y?).minus(&h.times(&x)).minus(&added(case, "observation_input", m, k)?.rows(&seen));
            gain = cov.over(&var)?;
            (x, p) = (x.plus(&gain.times(&e)), p.minus(&gain.times(&cov.t())).symmetric());
        }
        done.push(format!("{{{step},{}}}", laws("filtered", &x, &p)));
        if leaves {
            (x, p) = (a.times(&x).plus(&u), a.around(&p).plus(&q));
            if !seen.is_empty() {
                // What y_k tells about the noise of the transition that follows.
                let s = s.columns(&seen);
                let (weight, mixed) = (s.over(&var)?, a.times(&gain).times(&s.t()));
                x = x.plus(&weight.times(&e));
                p = p.minus(&mixed).minus(&mixed.t()).minus(&weight.times(&s.t()));
            }
            p = p.symmetric();
        }
    }
    Ok(())
}

fn answer(case: &Json) -> String {
    let id = case.field("id").map_or("", Json::text);
    if case.field("numbers").map_or("", Json::text) != "binary64" {
        return format!(r#"{{"id":"{id}","outcome":"unsupported"}}"#);
    }
    let mut done = Vec::new();
    // Matrices that do not fit panic: an error like any other, the next case is answered all the same.
    let found = catch_unwind(AssertUnwindSafe(|| filter(case, &mut done)));
    let outcome = match found.unwrap_or_else(|_| Err("matrices do not fit".into())) {
        Ok(()) => r#""answered""#.to_owned(),
        Err(reason) if reason == HEXADECIMAL => r#""unsupported""#.to_owned(),
        Err(reason) => format!(r#""error","step":{},"message":{reason:?}"#, done.len()),
    };
    format!(r#"{{"id":"{id}","outcome":{outcome},"steps":[{}]}}"#, done.join(","))
}

fn main() -> std::io::Result<()> {
    std::panic::set_hook(Box::new(|_| {})); // `answer` says it
    let mut out = std::io::stdout();
    writeln!(out, r#"{{"format":"exact-kalman/subject/1","name":"textbook, Rust","unsupported":["diffuse"]}}"#)?;
    for line in std::io::stdin().lock().lines() {
        let case = Json::read(line?.as_bytes(), &mut 0).unwrap_or(Json::Null);
        writeln!(out, "{}", answer(&case))?;
        out.flush()?;
    }
    Ok(())
}
