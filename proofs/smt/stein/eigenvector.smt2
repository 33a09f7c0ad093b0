; Identifiers: AK-L4.2-eigen
; Statement: Dx = λx ⇒ x*(F − DᵀFD)x = (1 − |λ|²)x*Fx, for complex λ = a + ib and x = u + iv.
; Size: 2×2 over the reals
; Expect: unsat
; Dx = λx put in: real and imaginary part of Dx are au − bv and bu + av, and x*Fx = uᵀFu + vᵀFv.
(set-logic QF_NRA)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const f22 Real)
(declare-const u1 Real)
(declare-const u2 Real)
(declare-const v1 Real)
(declare-const v2 Real)
(declare-const re Real)
(declare-const im Real)
(define-fun r1 () Real (- (* re u1) (* im v1)))
(define-fun r2 () Real (- (* re u2) (* im v2)))
(define-fun i1 () Real (+ (* im u1) (* re v1)))
(define-fun i2 () Real (+ (* im u2) (* re v2)))
; the conclusion, denied
(assert (not (= (- (+ (+ (* (+ (* u1 f11) (* u2 f12)) u1) (* (+ (* u1 f12) (* u2 f22)) u2)) (+ (* (+ (* v1 f11) (* v2 f12)) v1) (* (+ (* v1 f12) (* v2 f22)) v2))) (+ (+ (* (+ (* r1 f11) (* r2 f12)) r1) (* (+ (* r1 f12) (* r2 f22)) r2)) (+ (* (+ (* i1 f11) (* i2 f12)) i1) (* (+ (* i1 f12) (* i2 f22)) i2)))) (* (- 1 (+ (* re re) (* im im))) (+ (+ (* (+ (* u1 f11) (* u2 f12)) u1) (* (+ (* u1 f12) (* u2 f22)) u2)) (+ (* (+ (* v1 f11) (* v2 f12)) v1) (* (+ (* v1 f12) (* v2 f22)) v2)))))))
(check-sat)
