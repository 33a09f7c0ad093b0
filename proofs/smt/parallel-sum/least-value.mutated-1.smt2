; Identifiers: AK-Par
; Statement: xᵀ(F:G)x ≤ zᵀFz + (x − z)ᵀG(x − z) for every x and z and regular F + G ≥ 0, with equality at z = (F + G)⁻¹Gx.
; Control: a planted fault, the largest value, is refuted
; Size: 2×2 over the reals
; Expect: sat
; x = det(F + G) u for any u, so y = (F + G)⁻¹Gx needs no division; xᵀ(F:G)x is xᵀFy.
; Semidefiniteness is used at one vector, y − z, which is less than is given.
(set-logic QF_NRA)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const f22 Real)
(declare-const g11 Real)
(declare-const g12 Real)
(declare-const g22 Real)
(declare-const u1 Real)
(declare-const u2 Real)
(declare-const z1 Real)
(declare-const z2 Real)
(define-fun x1 () Real (* (- (* (+ f11 g11) (+ f22 g22)) (* (+ f12 g12) (+ f12 g12))) u1))
(define-fun x2 () Real (* (- (* (+ f11 g11) (+ f22 g22)) (* (+ f12 g12) (+ f12 g12))) u2))
(define-fun y1 () Real (+ (* (+ (* (+ f22 g22) g11) (* (- (+ f12 g12)) g12)) u1) (* (+ (* (+ f22 g22) g12) (* (- (+ f12 g12)) g22)) u2)))
(define-fun y2 () Real (+ (* (+ (* (- (+ f12 g12)) g11) (* (+ f11 g11) g12)) u1) (* (+ (* (- (+ f12 g12)) g12) (* (+ f11 g11) g22)) u2)))
(define-fun least () Real (+ (* (+ (* x1 f11) (* x2 f12)) y1) (* (+ (* x1 f12) (* x2 f22)) y2)))
(define-fun at-y () Real (+ (+ (* (+ (* y1 f11) (* y2 f12)) y1) (* (+ (* y1 f12) (* y2 f22)) y2)) (+ (* (+ (* (- x1 y1) g11) (* (- x2 y2) g12)) (- x1 y1)) (* (+ (* (- x1 y1) g12) (* (- x2 y2) g22)) (- x2 y2)))))
(define-fun at-z () Real (+ (+ (* (+ (* z1 f11) (* z2 f12)) z1) (* (+ (* z1 f12) (* z2 f22)) z2)) (+ (* (+ (* (- x1 z1) g11) (* (- x2 z2) g12)) (- x1 z1)) (* (+ (* (- x1 z1) g12) (* (- x2 z2) g22)) (- x2 z2)))))
; (y − z)ᵀ(F + G)(y − z) ≥ 0, as F + G ≥ 0
(assert (>= (+ (* (+ (* (- y1 z1) (+ f11 g11)) (* (- y2 z2) (+ f12 g12))) (- y1 z1)) (* (+ (* (- y1 z1) (+ f12 g12)) (* (- y2 z2) (+ f22 g22))) (- y2 z2))) 0))
; the conclusion, denied
(assert (not (>= least at-z)))
(check-sat)
