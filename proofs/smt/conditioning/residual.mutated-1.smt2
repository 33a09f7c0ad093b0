; Identifiers: none
; Statement: cov(X − P_xy P_yy⁻¹ Y, Y) = P_xy − P_xy P_yy⁻¹ P_yy = 0 for 2 + 2 with regular P_yy.
; Control: a planted fault, the sign of the correction, is refuted
; Size: 2 + 2 over the reals
; Expect: sat
; Multiplied by det P_yy.
(set-logic QF_NRA)
(declare-const c11 Real)
(declare-const c12 Real)
(declare-const c21 Real)
(declare-const c22 Real)
(declare-const y11 Real)
(declare-const y12 Real)
(declare-const y22 Real)
; the conclusion, denied
(assert (not (and (= (+ (* (- (* y11 y22) (* y12 y12)) c11) (+ (* (+ (* c11 y22) (* c12 (- y12))) y11) (* (+ (* c11 (- y12)) (* c12 y11)) y12))) 0) (= (+ (* (- (* y11 y22) (* y12 y12)) c12) (+ (* (+ (* c11 y22) (* c12 (- y12))) y12) (* (+ (* c11 (- y12)) (* c12 y11)) y22))) 0) (= (+ (* (- (* y11 y22) (* y12 y12)) c21) (+ (* (+ (* c21 y22) (* c22 (- y12))) y11) (* (+ (* c21 (- y12)) (* c22 y11)) y12))) 0) (= (+ (* (- (* y11 y22) (* y12 y12)) c22) (+ (* (+ (* c21 y22) (* c22 (- y12))) y12) (* (+ (* c21 (- y12)) (* c22 y11)) y22))) 0))))
(check-sat)
