; Identifiers: SM-4.7
; Statement: M and R of SM-4.5 and SM-2.4 make R* = M − R obey SM-4.7.
; Control: a planted fault, the printed SM-2.4, without the inverse of Σᵛ, is refuted
; Size: 2 states and 1 reading, over the reals
; Expect: sat
; Multiplied by JΣᵛ.
(set-logic QF_NRA)
(declare-const h11 Real)
(declare-const h12 Real)
(declare-const q11 Real)
(declare-const q12 Real)
(declare-const q21 Real)
(declare-const q22 Real)
(declare-const i11 Real)
(declare-const i12 Real)
(declare-const i21 Real)
(declare-const i22 Real)
(declare-const m11 Real)
(declare-const m12 Real)
(declare-const m22 Real)
(declare-const r11 Real)
(declare-const r12 Real)
(declare-const r22 Real)
(declare-const j Real)
(declare-const v Real)
; the conclusion, denied
(assert (not (and (= (- (+ (* (* j v) m11) (* j (+ (* (* (+ (* i11 h11) (* i21 h12)) h11) i11) (* (* (+ (* i11 h11) (* i21 h12)) h12) i21)))) (+ (- (* (* j v) r11) (* v (+ (* (* (+ (* q11 h11) (* q21 h12)) h11) q11) (* (* (+ (* q11 h11) (* q21 h12)) h12) q21)))) (* v (* j (+ (* (* (+ (* i11 h11) (* i21 h12)) h11) i11) (* (* (+ (* i11 h11) (* i21 h12)) h12) i21)))))) (+ (* (* j v) (- m11 r11)) (* v (+ (* (* (+ (* q11 h11) (* q21 h12)) h11) q11) (* (* (+ (* q11 h11) (* q21 h12)) h12) q21))))) (= (- (+ (* (* j v) m12) (* j (+ (* (* (+ (* i11 h11) (* i21 h12)) h11) i12) (* (* (+ (* i11 h11) (* i21 h12)) h12) i22)))) (+ (- (* (* j v) r12) (* v (+ (* (* (+ (* q11 h11) (* q21 h12)) h11) q12) (* (* (+ (* q11 h11) (* q21 h12)) h12) q22)))) (* v (* j (+ (* (* (+ (* i11 h11) (* i21 h12)) h11) i12) (* (* (+ (* i11 h11) (* i21 h12)) h12) i22)))))) (+ (* (* j v) (- m12 r12)) (* v (+ (* (* (+ (* q11 h11) (* q21 h12)) h11) q12) (* (* (+ (* q11 h11) (* q21 h12)) h12) q22))))) (= (- (+ (* (* j v) m12) (* j (+ (* (* (+ (* i12 h11) (* i22 h12)) h11) i11) (* (* (+ (* i12 h11) (* i22 h12)) h12) i21)))) (+ (- (* (* j v) r12) (* v (+ (* (* (+ (* q12 h11) (* q22 h12)) h11) q11) (* (* (+ (* q12 h11) (* q22 h12)) h12) q21)))) (* v (* j (+ (* (* (+ (* i12 h11) (* i22 h12)) h11) i11) (* (* (+ (* i12 h11) (* i22 h12)) h12) i21)))))) (+ (* (* j v) (- m12 r12)) (* v (+ (* (* (+ (* q12 h11) (* q22 h12)) h11) q11) (* (* (+ (* q12 h11) (* q22 h12)) h12) q21))))) (= (- (+ (* (* j v) m22) (* j (+ (* (* (+ (* i12 h11) (* i22 h12)) h11) i12) (* (* (+ (* i12 h11) (* i22 h12)) h12) i22)))) (+ (- (* (* j v) r22) (* v (+ (* (* (+ (* q12 h11) (* q22 h12)) h11) q12) (* (* (+ (* q12 h11) (* q22 h12)) h12) q22)))) (* v (* j (+ (* (* (+ (* i12 h11) (* i22 h12)) h11) i12) (* (* (+ (* i12 h11) (* i22 h12)) h12) i22)))))) (+ (* (* j v) (- m22 r22)) (* v (+ (* (* (+ (* q12 h11) (* q22 h12)) h11) q12) (* (* (+ (* q12 h11) (* q22 h12)) h12) q22))))))))
(check-sat)
