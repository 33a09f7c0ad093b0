; Identifiers: HV-X.ad
; Statement: C(Az + Bu + Dw) + Gv + Fw = CAz + CBu + Gv + (CD + F)w: the observation.
; Size: 2 states, 1 reading and 2 noises, over the reals
; Expect: unsat
; b is Bu, g is Gv.
(set-logic QF_NRA)
(declare-const a11 Real)
(declare-const a12 Real)
(declare-const a21 Real)
(declare-const a22 Real)
(declare-const c11 Real)
(declare-const c12 Real)
(declare-const d11 Real)
(declare-const d12 Real)
(declare-const d21 Real)
(declare-const d22 Real)
(declare-const f11 Real)
(declare-const f12 Real)
(declare-const z1 Real)
(declare-const z2 Real)
(declare-const b1 Real)
(declare-const b2 Real)
(declare-const w1 Real)
(declare-const w2 Real)
(declare-const g Real)
; the conclusion, denied
(assert (not (= (+ (+ (+ (* c11 (+ (+ (+ (* a11 z1) (* a12 z2)) b1) (+ (* d11 w1) (* d12 w2)))) (* c12 (+ (+ (+ (* a21 z1) (* a22 z2)) b2) (+ (* d21 w1) (* d22 w2))))) g) (+ (* f11 w1) (* f12 w2))) (+ (+ (+ (+ (* (+ (* c11 a11) (* c12 a21)) z1) (* (+ (* c11 a12) (* c12 a22)) z2)) (+ (* c11 b1) (* c12 b2))) g) (+ (* (+ (+ (* c11 d11) (* c12 d21)) f11) w1) (* (+ (+ (* c11 d12) (* c12 d22)) f12) w2))))))
(check-sat)
