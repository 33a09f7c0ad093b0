; Identifiers: EK-L3
; Statement: (KΣ − Γ)Σ⁻¹(KΣ − Γ)ᵀ ≥ 0 for Σ > 0, so that no gain does better: the inequality.
; Control: a planted fault, a positive square for every x, is refuted
; Size: 2 states and 2 readings, over the reals
; Expect: sat
; For M = KΣ − Γ, any matrix, and every x. Multiplied by det Σ > 0.
(set-logic QF_NRA)
(declare-const m11 Real)
(declare-const m12 Real)
(declare-const m21 Real)
(declare-const m22 Real)
(declare-const s11 Real)
(declare-const s12 Real)
(declare-const s22 Real)
(declare-const x1 Real)
(declare-const x2 Real)
; Σ > 0
(assert (and (> s11 0) (> (- (* s11 s22) (* s12 s12)) 0)))
; the conclusion, denied
(assert (not (> (+ (* (+ (* x1 (+ (* (+ (* m11 s22) (* m12 (- s12))) m11) (* (+ (* m11 (- s12)) (* m12 s11)) m12))) (* x2 (+ (* (+ (* m21 s22) (* m22 (- s12))) m11) (* (+ (* m21 (- s12)) (* m22 s11)) m12)))) x1) (* (+ (* x1 (+ (* (+ (* m11 s22) (* m12 (- s12))) m21) (* (+ (* m11 (- s12)) (* m12 s11)) m22))) (* x2 (+ (* (+ (* m21 s22) (* m22 (- s12))) m21) (* (+ (* m21 (- s12)) (* m22 s11)) m22)))) x2)) 0)))
(check-sat)
