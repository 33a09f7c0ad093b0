; Identifiers: AK-Par-inverse
; Statement: (F:G)⁻¹ = F⁻¹ + G⁻¹ for F, G > 0: (F:G)(F⁻¹ + G⁻¹) = I.
; Size: 2×2 over the reals
; Expect: unsat
; d is det(F + G); n is d times F:G, so that nothing is divided.
; Multiplied by det F · det G · d.
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
(define-fun i11 () Real (+ (* (- (* g11 g22) (* g12 g12)) f22) (* (- (* f11 f22) (* f12 f12)) g22)))
(define-fun i12 () Real (+ (* (- (* g11 g22) (* g12 g12)) (- f12)) (* (- (* f11 f22) (* f12 f12)) (- g12))))
(define-fun i21 () Real (+ (* (- (* g11 g22) (* g12 g12)) (- f12)) (* (- (* f11 f22) (* f12 f12)) (- g12))))
(define-fun i22 () Real (+ (* (- (* g11 g22) (* g12 g12)) f11) (* (- (* f11 f22) (* f12 f12)) g11)))
(define-fun e () Real (* d (- (* f11 f22) (* f12 f12)) (- (* g11 g22) (* g12 g12))))
; F > 0
(assert (and (> f11 0) (> (- (* f11 f22) (* f12 f12)) 0)))
; G > 0
(assert (and (> g11 0) (> (- (* g11 g22) (* g12 g12)) 0)))
; the conclusion, denied
(assert (not (and (and (= (+ (* n11 i11) (* n12 i21)) e) (= (+ (* n11 i12) (* n12 i22)) 0) (= (+ (* n21 i11) (* n22 i21)) 0) (= (+ (* n21 i12) (* n22 i22)) e)) (distinct e 0))))
(check-sat)
