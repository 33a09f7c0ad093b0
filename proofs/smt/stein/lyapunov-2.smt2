; Identifiers: AK-L4.2
; Statement: F > 0, F − DᵀFD > 0 ⇒ tr D < 1 + det D: one of three parts of Jury's criterion for ρ(D) < 1.
; Size: 2×2 over the reals
; Expect: unsat
(set-logic QF_NRA)
(declare-const d11 Real)
(declare-const d12 Real)
(declare-const d21 Real)
(declare-const d22 Real)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const f22 Real)
(define-fun r11 () Real (- f11 (+ (* (+ (* d11 f11) (* d21 f12)) d11) (* (+ (* d11 f12) (* d21 f22)) d21))))
(define-fun r12 () Real (- f12 (+ (* (+ (* d11 f11) (* d21 f12)) d12) (* (+ (* d11 f12) (* d21 f22)) d22))))
(define-fun r21 () Real (- f12 (+ (* (+ (* d12 f11) (* d22 f12)) d11) (* (+ (* d12 f12) (* d22 f22)) d21))))
(define-fun r22 () Real (- f22 (+ (* (+ (* d12 f11) (* d22 f12)) d12) (* (+ (* d12 f12) (* d22 f22)) d22))))
; F > 0
(assert (and (> f11 0) (> (- (* f11 f22) (* f12 f12)) 0)))
; F − DᵀFD > 0
(assert (and (> r11 0) (> (- (* r11 r22) (* r12 r21)) 0)))
; the conclusion, denied
(assert (not (< (+ d11 d22) (+ 1 (- (* d11 d22) (* d12 d21))))))
(check-sat)
