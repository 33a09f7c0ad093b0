; Identifiers: WG-L2.2
; Statement: P(k+1) = GP(k)Gᵀ + Q̄, P(k+1) ≤ cQ̄, c > 0 ⇒ GP(k)Gᵀ ≤ (1 − 1/c)P(k+1): one step of the proof, G = F(I − LH).
; Control: a planted fault, 1 − 2/c, is refuted
; Size: 2×2 over the reals
; Expect: sat
; g is GP(k)Gᵀ, n is P(k+1).
(set-logic QF_NRA)
(declare-const g11 Real)
(declare-const g12 Real)
(declare-const g22 Real)
(declare-const q11 Real)
(declare-const q12 Real)
(declare-const q22 Real)
(declare-const c Real)
(define-fun n11 () Real (+ g11 q11))
(define-fun n12 () Real (+ g12 q12))
(define-fun n21 () Real (+ g12 q12))
(define-fun n22 () Real (+ g22 q22))
; P(k+1) ≤ cQ̄
(assert (and (>= (- (* c q11) n11) 0) (>= (- (* c q22) n22) 0) (>= (- (* (- (* c q11) n11) (- (* c q22) n22)) (* (- (* c q12) n12) (- (* c q12) n21))) 0)))
; c > 0
(assert (> c 0))
; the conclusion, denied
(assert (not (and (>= (- (* (- c 2) n11) (* c g11)) 0) (>= (- (* (- c 2) n22) (* c g22)) 0) (>= (- (* (- (* (- c 2) n11) (* c g11)) (- (* (- c 2) n22) (* c g22))) (* (- (* (- c 2) n12) (* c g12)) (- (* (- c 2) n21) (* c g12)))) 0))))
(check-sat)
