; Identifiers: AK-L4.1iii
; Statement: F ≤ H ⇒ F:I ≤ H:I for F ≥ 0: the case G = I, as matrices.
; Control: without E = H − F ≥ 0 there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
; h is H = F + E; n and m are det(F + I) F:I and det(H + I) H:I.
(set-logic QF_NRA)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const f22 Real)
(declare-const e11 Real)
(declare-const e12 Real)
(declare-const e22 Real)
(define-fun h11 () Real (+ f11 e11))
(define-fun h12 () Real (+ f12 e12))
(define-fun h21 () Real (+ f12 e12))
(define-fun h22 () Real (+ f22 e22))
(define-fun t11 () Real (+ f11 1))
(define-fun t12 () Real f12)
(define-fun t21 () Real f12)
(define-fun t22 () Real (+ f22 1))
(define-fun u11 () Real (+ h11 1))
(define-fun u12 () Real h12)
(define-fun u21 () Real h21)
(define-fun u22 () Real (+ h22 1))
(define-fun d () Real (- (* t11 t22) (* t12 t21)))
(define-fun k () Real (- (* u11 u22) (* u12 u21)))
(define-fun n11 () Real (+ (* f11 t22) (* f12 (- t21))))
(define-fun n12 () Real (+ (* f11 (- t12)) (* f12 t11)))
(define-fun n21 () Real (+ (* f12 t22) (* f22 (- t21))))
(define-fun n22 () Real (+ (* f12 (- t12)) (* f22 t11)))
(define-fun m11 () Real (+ (* h11 u22) (* h12 (- u21))))
(define-fun m12 () Real (+ (* h11 (- u12)) (* h12 u11)))
(define-fun m21 () Real (+ (* h21 u22) (* h22 (- u21))))
(define-fun m22 () Real (+ (* h21 (- u12)) (* h22 u11)))
; F ≥ 0
(assert (and (>= f11 0) (>= f22 0) (>= (- (* f11 f22) (* f12 f12)) 0)))
; the conclusion, denied
(assert (not (and (>= (- (* d m11) (* k n11)) 0) (>= (- (* d m22) (* k n22)) 0) (>= (- (* (- (* d m11) (* k n11)) (- (* d m22) (* k n22))) (* (- (* d m12) (* k n12)) (- (* d m21) (* k n21)))) 0))))
(check-sat)
