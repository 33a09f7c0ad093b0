; Identifiers: SM-4.6
; Statement: Q and Ψ of SM-2.3 and SM-1.7 make Q* = Q + Ψ obey SM-4.6.
; Control: a planted fault, the sign of the gain, is refuted
; Size: 2 states and 1 reading, over the reals
; Expect: sat
; Multiplied by JΣᵛ.
(set-logic QF_NRA)
(declare-const a11 Real)
(declare-const a12 Real)
(declare-const a21 Real)
(declare-const a22 Real)
(declare-const h11 Real)
(declare-const h12 Real)
(declare-const p11 Real)
(declare-const p12 Real)
(declare-const p22 Real)
(declare-const c1 Real)
(declare-const c2 Real)
(declare-const q11 Real)
(declare-const q12 Real)
(declare-const q21 Real)
(declare-const q22 Real)
(declare-const i11 Real)
(declare-const i12 Real)
(declare-const i21 Real)
(declare-const i22 Real)
(declare-const v Real)
(define-fun j () Real (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) v))
(define-fun k1 () Real (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1))
(define-fun k2 () Real (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2))
; the conclusion, denied
(assert (not (and (= (+ (+ (- (* (* j v) (+ (* a11 q11) (* a12 q21))) (* v (+ (* (* k1 h11) (+ q11 i11)) (* (* k1 h12) (+ q21 i21))))) (* j (+ (* (* c1 h11) i11) (* (* c1 h12) i21)))) (- (* (* j v) (+ (* a11 i11) (* a12 i21))) (* j (+ (* (* c1 h11) i11) (* (* c1 h12) i21))))) (+ (* (* j v) (+ (* a11 (+ q11 i11)) (* a12 (+ q21 i21)))) (* v (+ (* (* k1 h11) (+ q11 i11)) (* (* k1 h12) (+ q21 i21)))))) (= (+ (+ (- (* (* j v) (+ (* a11 q12) (* a12 q22))) (* v (+ (* (* k1 h11) (+ q12 i12)) (* (* k1 h12) (+ q22 i22))))) (* j (+ (* (* c1 h11) i12) (* (* c1 h12) i22)))) (- (* (* j v) (+ (* a11 i12) (* a12 i22))) (* j (+ (* (* c1 h11) i12) (* (* c1 h12) i22))))) (+ (* (* j v) (+ (* a11 (+ q12 i12)) (* a12 (+ q22 i22)))) (* v (+ (* (* k1 h11) (+ q12 i12)) (* (* k1 h12) (+ q22 i22)))))) (= (+ (+ (- (* (* j v) (+ (* a21 q11) (* a22 q21))) (* v (+ (* (* k2 h11) (+ q11 i11)) (* (* k2 h12) (+ q21 i21))))) (* j (+ (* (* c2 h11) i11) (* (* c2 h12) i21)))) (- (* (* j v) (+ (* a21 i11) (* a22 i21))) (* j (+ (* (* c2 h11) i11) (* (* c2 h12) i21))))) (+ (* (* j v) (+ (* a21 (+ q11 i11)) (* a22 (+ q21 i21)))) (* v (+ (* (* k2 h11) (+ q11 i11)) (* (* k2 h12) (+ q21 i21)))))) (= (+ (+ (- (* (* j v) (+ (* a21 q12) (* a22 q22))) (* v (+ (* (* k2 h11) (+ q12 i12)) (* (* k2 h12) (+ q22 i22))))) (* j (+ (* (* c2 h11) i12) (* (* c2 h12) i22)))) (- (* (* j v) (+ (* a21 i12) (* a22 i22))) (* j (+ (* (* c2 h11) i12) (* (* c2 h12) i22))))) (+ (* (* j v) (+ (* a21 (+ q12 i12)) (* a22 (+ q22 i22)))) (* v (+ (* (* k2 h11) (+ q12 i12)) (* (* k2 h12) (+ q22 i22)))))))))
(check-sat)
