; Identifiers: EK-L5
; Statement: −W ≤ Z ≤ W ⇒ (uᵀZv)² ≤ uᵀWu · vᵀWv: the first half.
; Control: without W − Z ≥ 0 there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
; In the basis u, v, if they are independent: u = (1, 0), v = (0, 1). Dependent ones need |uᵀZu| ≤ uᵀWu alone.
(set-logic QF_NRA)
(declare-const z11 Real)
(declare-const z12 Real)
(declare-const z22 Real)
(declare-const w11 Real)
(declare-const w12 Real)
(declare-const w22 Real)
; W + Z ≥ 0
(assert (and (>= (+ w11 z11) 0) (>= (+ w22 z22) 0) (>= (- (* (+ w11 z11) (+ w22 z22)) (* (+ w12 z12) (+ w12 z12))) 0)))
; the conclusion, denied
(assert (not (<= (* z12 z12) (* w11 w22))))
(check-sat)
