; Identifiers: none
; Statement: Jury's criterion: det D < 1 and |tr D| < 1 + det D ⇒ |λ| < 1 for every eigenvalue λ = a + ib.
; Control: without the imaginary part of the characteristic equation there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
; λ² − tr(D) λ + det D = 0, real and imaginary part.
(set-logic QF_NRA)
(declare-const trace Real)
(declare-const det Real)
(declare-const re Real)
(declare-const im Real)
; det D < 1
(assert (< det 1))
; tr D < 1 + det D
(assert (< trace (+ 1 det)))
; −tr D < 1 + det D
(assert (< (- trace) (+ 1 det)))
; the real part of the characteristic equation
(assert (= (+ (- (* re re) (* im im)) (- (* trace re)) det) 0))
; the conclusion, denied
(assert (not (< (+ (* re re) (* im im)) 1)))
(check-sat)
