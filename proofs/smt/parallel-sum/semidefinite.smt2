; Identifiers: AK-L4.1ii
; Statement: F:G ≥ 0 for F, G ≥ 0 with F + G > 0.
; Size: 2×2 over the reals
; Expect: unsat
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
; F ≥ 0
(assert (and (>= f11 0) (>= f22 0) (>= (- (* f11 f22) (* f12 f12)) 0)))
; G ≥ 0
(assert (and (>= g11 0) (>= g22 0) (>= (- (* g11 g22) (* g12 g12)) 0)))
; F + G is regular
(assert (distinct d 0))
; the conclusion, denied
(assert (not (and (> d 0) (and (>= n11 0) (>= n22 0) (>= (- (* n11 n22) (* n12 n21)) 0)))))
(check-sat)
