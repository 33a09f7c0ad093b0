; Identifiers: EK-L2
; Statement: P ≥ 0 and M ≥ 0 ⇒ ΓΣ⁺Σ = Γ, that is: Σ = 0 ⇒ Γ = 0.
; Control: without P ≥ 0 there is a counter-example
; Size: 1 state and 1 reading, over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const a Real)
(declare-const h Real)
(declare-const q Real)
(declare-const c Real)
(declare-const r Real)
(declare-const p Real)
; Q ≥ 0 and R ≥ 0
(assert (and (>= q 0) (>= r 0)))
; QR ≥ S²
(assert (>= (* q r) (* c c)))
; Σ = 0
(assert (= (+ (* h p h) r) 0))
; the conclusion, denied
(assert (not (= (+ (* a p h) c) 0)))
(check-sat)
