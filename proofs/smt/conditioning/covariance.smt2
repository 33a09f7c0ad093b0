; Identifiers: none
; Statement: P_xx − P_xy P_yy⁻¹ P_yx is positive semidefinite and at most P_xx, for a joint covariance ≥ 0 of 2 + 1 with P_yy > 0.
; Size: 2 states and 1 reading, over the reals
; Expect: unsat
; n is P_yy(P_xx − P_xy P_yy⁻¹ P_yx). The joint covariance is ≥ 0: all its principal minors are.
(set-logic QF_NRA)
(declare-const x11 Real)
(declare-const x12 Real)
(declare-const x22 Real)
(declare-const c1 Real)
(declare-const c2 Real)
(declare-const y Real)
(define-fun n11 () Real (- (* y x11) (* c1 c1)))
(define-fun n12 () Real (- (* y x12) (* c1 c2)))
(define-fun n21 () Real (- (* y x12) (* c2 c1)))
(define-fun n22 () Real (- (* y x22) (* c2 c2)))
; minors of order 1
(assert (and (>= x11 0) (>= x22 0) (>= y 0)))
; minors of order 2
(assert (and (>= (- (* x11 x22) (* x12 x12)) 0) (>= n11 0) (>= n22 0)))
; the determinant
(assert (>= (+ (* x11 (- (* x22 y) (* c2 c2))) (- (* x12 (- (* x12 y) (* c1 c2)))) (* c1 (- (* x12 c2) (* x22 c1)))) 0))
; P_yy is regular
(assert (distinct y 0))
; the conclusion, denied
(assert (not (and (and (>= n11 0) (>= n22 0) (>= (- (* n11 n22) (* n12 n21)) 0)) (and (>= (- (* y x11) n11) 0) (>= (- (* y x22) n22) 0) (>= (- (* (- (* y x11) n11) (- (* y x22) n22)) (* (- (* y x12) n12) (- (* y x12) n21))) 0)))))
(check-sat)
