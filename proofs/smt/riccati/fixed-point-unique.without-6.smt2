; Identifiers: AK-T2.3
; Statement: V > 0, W ≥ 0 ⇒ φ has at most one fixed point S > 0: the uniqueness; scalar.
; Control: without T = φ(T) there is a counter-example
; Size: scalar, over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const a Real)
(declare-const w Real)
(declare-const v Real)
(declare-const s Real)
(declare-const t Real)
; V > 0
(assert (> v 0))
; W ≥ 0
(assert (>= w 0))
; S > 0
(assert (> s 0))
; S = φ(S)
(assert (= (* (- s v) (+ s w)) (* a a s w)))
; T > 0
(assert (> t 0))
; the conclusion, denied
(assert (not (= s t)))
(check-sat)
