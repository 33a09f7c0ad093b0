; Identifiers: none
; Statement: (KΣ − Γ)Σ⁻¹(KΣ − Γ)ᵀ ≥ 0 for Σ > 0, so that no gain does better: the inequality.
; Size: 2 states and 1 reading, over the reals
; Expect: unsat
; For M = KΣ − Γ, any matrix, and every x. Multiplied by det Σ > 0.
(set-logic QF_NRA)
(declare-const m1 Real)
(declare-const m2 Real)
(declare-const s Real)
(declare-const x1 Real)
(declare-const x2 Real)
; Σ > 0
(assert (> s 0))
; the conclusion, denied
(assert (not (>= (+ (* (+ (* x1 (* m1 m1)) (* x2 (* m2 m1))) x1) (* (+ (* x1 (* m1 m2)) (* x2 (* m2 m2))) x2)) 0)))
(check-sat)
