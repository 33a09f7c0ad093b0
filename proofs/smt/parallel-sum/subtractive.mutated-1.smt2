; Identifiers: AK-L4.1iv
; Statement: F(F + G)⁻¹G = F − F(F + G)⁻¹F, for all symmetric F and G with regular F + G.
; Control: a planted fault, the sign of the second term, is refuted
; Size: 2×2 over the reals
; Expect: sat
; d is det(F + G); n is d times F:G, so that nothing is divided.
(set-logic QF_NRA)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const f22 Real)
(declare-const g11 Real)
(declare-const g12 Real)
(declare-const g22 Real)
(define-fun t11 () Real (+ f11 g11))
(define-fun t12 () Real (+ f12 g12))
(define-fun t21 () Real (+ f12 g12))
(define-fun t22 () Real (+ f22 g22))
(define-fun d () Real (- (* t11 t22) (* t12 t21)))
(define-fun n11 () Real (+ (* (+ (* f11 t22) (* f12 (- t21))) g11) (* (+ (* f11 (- t12)) (* f12 t11)) g12)))
(define-fun n12 () Real (+ (* (+ (* f11 t22) (* f12 (- t21))) g12) (* (+ (* f11 (- t12)) (* f12 t11)) g22)))
(define-fun n21 () Real (+ (* (+ (* f12 t22) (* f22 (- t21))) g11) (* (+ (* f12 (- t12)) (* f22 t11)) g12)))
(define-fun n22 () Real (+ (* (+ (* f12 t22) (* f22 (- t21))) g12) (* (+ (* f12 (- t12)) (* f22 t11)) g22)))
; the conclusion, denied
(assert (not (and (= n11 (+ (* d f11) (+ (* (+ (* f11 t22) (* f12 (- t21))) f11) (* (+ (* f11 (- t12)) (* f12 t11)) f12)))) (= n12 (+ (* d f12) (+ (* (+ (* f11 t22) (* f12 (- t21))) f12) (* (+ (* f11 (- t12)) (* f12 t11)) f22)))) (= n21 (+ (* d f12) (+ (* (+ (* f12 t22) (* f22 (- t21))) f11) (* (+ (* f12 (- t12)) (* f22 t11)) f12)))) (= n22 (+ (* d f22) (+ (* (+ (* f12 t22) (* f22 (- t21))) f12) (* (+ (* f12 (- t12)) (* f22 t11)) f22)))))))
(check-sat)
