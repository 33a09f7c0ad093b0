# A textbook Kalman filter in R (base only) as a subject: exact-kalman check -- Rscript textbook.R

# A reader of JSON: objects and lists become lists, a string its text as it stands, escapes included, null NULL.
read_json <- function(line) {
  token <- regmatches(line, gregexpr('"([^"\\\\]|\\\\.)*"|[][{}:,]|[^][{}:,"[:space:]]+', line, perl = TRUE, useBytes = TRUE))[[1]]
  at <- 0
  value <- function() {
    at <<- at + 1
    open <- token[at]
    if (open == "null") return(NULL)
    if (open != "[" && open != "{") return(gsub('^"|"$', "", open, useBytes = TRUE))
    items <- list()
    while (!(token[at + 1] %in% c("]", "}"))) {
      if (token[at + 1] == ",") at <<- at + 1
      key <- length(items) + 1
      if (open == "{") { key <- value(); at <<- at + 1 }  # the key, and past its colon
      item <- value()
      items[key] <- list(item)  # so that NULL is kept
    }
    at <<- at + 1
    items
  }
  value()
}

depth <- function(value) if (is.list(value)) 1 + max(0, sapply(value, depth)) else 0
vector_of <- function(row) {
  numbers <- suppressWarnings(as.numeric(unlist(row)))
  if (any(is.na(numbers) & !is.nan(numbers))) stop("a literal is no number")  # NA would be printed
  numbers
}
matrix_of <- function(rows) do.call(rbind, lapply(rows, vector_of))

# The function k -> value of a constant, or of a list with one value per observation.
along <- function(value, deep) {
  per_step <- depth(value) > deep || any(sapply(value, is.null))
  as <- if (deep == 1) vector_of else matrix_of
  function(k) as(if (per_step) value[[k]] else value)
}

# The functions k -> Q, k -> cov(process noise, observation noise), k -> R.
law <- function(noise, n, m) {
  if (!is.null(noise$process_factor)) {
    d <- along(noise$process_factor, 2); f <- along(noise$observation_factor, 2)
    return(list(q = function(k) d(k) %*% t(d(k)), s = function(k) d(k) %*% t(f(k)), r = function(k) f(k) %*% t(f(k))))
  }
  cross <- if (is.null(noise$cross)) function(k) matrix(0, n, m) else along(noise$cross, 2)
  list(q = along(noise$process, 2), s = cross, r = along(noise$observation, 2))
}

# The function k -> B u.
added <- function(term, size) {
  if (is.null(term)) return(function(k) numeric(size))
  vector <- along(term$vector, 1)
  if (is.null(term$matrix)) return(vector)
  matrix <- along(term$matrix, 2)
  function(k) matrix(k) %*% vector(k)
}

text_of <- function(x) {
  row <- function(entries) paste0("[", paste0('"', sprintf("%.17g", entries), '"', collapse = ","), "]")
  if (is.matrix(x)) paste0("[", paste(apply(x, 1, row), collapse = ","), "]") else row(x)
}

steps <- function(case, done) {
  arriving <- case$timing == "arriving"
  a <- along(case$transition, 2); h_all <- along(case$observation, 2)
  x <- vector_of(case$initial$mean); p <- matrix_of(case$initial$covariance)
  n <- length(x); m <- nrow(h_all(1)); noise <- law(case$noise, n, m)
  u <- added(case$input, n); v <- added(case$observation_input, m)
  count <- length(case$observations)
  for (k in seq_len(count)) {
    leads_here <- arriving && (k > 1 || case$initial$before == "transition")
    if (leads_here) { x <- c(a(k) %*% x + u(k)); p <- a(k) %*% p %*% t(a(k)) + noise$q(k) }
    step <- sprintf('"predicted_mean":%s,"predicted_covariance":%s', text_of(x), text_of(p))
    reading <- case$observations[[k]]
    seen <- which(!vapply(reading, is.null, TRUE))
    if (length(seen)) {
      h <- h_all(k)[seen, , drop = FALSE]
      shared <- if (leads_here) noise$s(k)[, seen, drop = FALSE] else matrix(0, n, length(seen))  # cov(x_k, noise of y_k)
      cov <- p %*% t(h) + shared
      var <- h %*% cov + noise$r(k)[seen, seen, drop = FALSE] + t(h %*% shared)
      e <- vector_of(reading[seen]) - h %*% x - v(k)[seen]
      gain <- t(solve(var, t(cov), tol = 0))
      x <- c(x + gain %*% e); p <- p - gain %*% t(cov); p <- (p + t(p)) / 2
    }
    done(sprintf('{%s,"filtered_mean":%s,"filtered_covariance":%s}', step, text_of(x), text_of(p)))
    if (!arriving && k < count) {
      x <- c(a(k) %*% x + u(k)); p <- a(k) %*% p %*% t(a(k)) + noise$q(k)
      if (length(seen)) {  # what y_k tells about the noise of the transition that follows
        s <- noise$s(k)[, seen, drop = FALSE]
        weight <- t(solve(var, t(s), tol = 0)); mixed <- a(k) %*% gain %*% t(s)
        x <- c(x + weight %*% e); p <- p - mixed - t(mixed) - weight %*% t(s)
      }
    }
    p <- (p + t(p)) / 2
  }
}

answer <- function(case) {
  if (case$numbers != "binary64") return(sprintf('{"id":"%s","outcome":"unsupported"}', case$id))
  written <- character()
  failed <- tryCatch({ steps(case, function(step) written <<- c(written, step)); FALSE }, error = function(reason) TRUE)
  outcome <- if (failed) sprintf('"error","step":%d', length(written)) else '"answered"'
  sprintf('{"id":"%s","outcome":%s,"steps":[%s]}', case$id, outcome, paste(written, collapse = ","))
}

say <- function(line) { cat(line, "\n", sep = ""); flush(stdout()) }
say(sprintf('{"format":"exact-kalman/subject/1","name":"textbook, %s","unsupported":["diffuse"]}', R.version.string))
input <- file("stdin", "r")
while (length(line <- readLines(input, n = 1)) > 0) say(answer(read_json(line)))
