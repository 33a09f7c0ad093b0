; Identifiers: AK-L4.3
; Statement: V > 0, T = φ(T) ⇒ |λ| < 1 for the eigenvalues of D = AW(T + W)⁻¹; scalar.
; Control: without D(T + W) = AW there is a counter-example
; Size: scalar, over the reals
; Expect: sat
; n = 1: λ = D, and D(T + W) = AW.
(set-logic QF_NRA)
(declare-const a Real)
(declare-const w Real)
(declare-const v Real)
(declare-const t Real)
(declare-const l Real)
; V > 0
(assert (> v 0))
; W ≥ 0
(assert (>= w 0))
; T > 0
(assert (> t 0))
; T = φ(T)
(assert (= (* (- t v) (+ t w)) (* a a t w)))
; the conclusion, denied
(assert (not (< (* l l) 1)))
(check-sat)
