; Identifiers: CKS-10.form
; Statement: APAᵀCᵀ + D(F + CD)ᵀ = RCᵀ + DFᵀ with R = APAᵀ + DDᵀ.
; Control: a planted fault, without the second noise term, is refuted
; Size: 2 states, 1 reading and 2 noises, over the reals
; Expect: sat
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
(declare-const p11 Real)
(declare-const p12 Real)
(declare-const p22 Real)
; the conclusion, denied
(assert (not (and (= (+ (+ (* (+ (* (+ (* a11 p11) (* a12 p12)) a11) (* (+ (* a11 p12) (* a12 p22)) a12)) c11) (* (+ (* (+ (* a11 p11) (* a12 p12)) a21) (* (+ (* a11 p12) (* a12 p22)) a22)) c12)) (+ (* d11 (+ f11 (+ (* c11 d11) (* c12 d21)))) (* d12 (+ f12 (+ (* c11 d12) (* c12 d22)))))) (+ (* (+ (+ (* (+ (* a11 p11) (* a12 p12)) a11) (* (+ (* a11 p12) (* a12 p22)) a12)) (+ (* d11 d11) (* d12 d12))) c11) (* (+ (+ (* (+ (* a11 p11) (* a12 p12)) a21) (* (+ (* a11 p12) (* a12 p22)) a22)) (+ (* d11 d21) (* d12 d22))) c12))) (= (+ (+ (* (+ (* (+ (* a21 p11) (* a22 p12)) a11) (* (+ (* a21 p12) (* a22 p22)) a12)) c11) (* (+ (* (+ (* a21 p11) (* a22 p12)) a21) (* (+ (* a21 p12) (* a22 p22)) a22)) c12)) (+ (* d21 (+ f11 (+ (* c11 d11) (* c12 d21)))) (* d22 (+ f12 (+ (* c11 d12) (* c12 d22)))))) (+ (* (+ (+ (* (+ (* a21 p11) (* a22 p12)) a11) (* (+ (* a21 p12) (* a22 p22)) a12)) (+ (* d21 d11) (* d22 d12))) c11) (* (+ (+ (* (+ (* a21 p11) (* a22 p12)) a21) (* (+ (* a21 p12) (* a22 p22)) a22)) (+ (* d21 d21) (* d22 d22))) c12))))))
(check-sat)
