; Identifiers: EK-L5
; Statement: −W ≤ Z ≤ W ⇒ Zxxᵀ Z ≤ xᵀWx W: the second half for X = xxᵀ.
; Control: without W + Z ≥ 0 there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
; x = (1, 0), in a suitable basis; every X ≥ 0 is a sum of such.
(set-logic QF_NRA)
(declare-const z11 Real)
(declare-const z12 Real)
(declare-const z22 Real)
(declare-const w11 Real)
(declare-const w12 Real)
(declare-const w22 Real)
; W − Z ≥ 0
(assert (and (>= (- w11 z11) 0) (>= (- w22 z22) 0) (>= (- (* (- w11 z11) (- w22 z22)) (* (- w12 z12) (- w12 z12))) 0)))
; the conclusion, denied
(assert (not (and (>= (- (* w11 w11) (* z11 z11)) 0) (>= (- (* w11 w22) (* z12 z12)) 0) (>= (- (* (- (* w11 w11) (* z11 z11)) (- (* w11 w22) (* z12 z12))) (* (- (* w11 w12) (* z11 z12)) (- (* w11 w12) (* z12 z11)))) 0))))
(check-sat)
