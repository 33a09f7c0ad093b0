; Identifiers: EK-L1
; Statement: J(P, K) = APAᵀ + Q − KΓᵀ − ΓKᵀ + KΣKᵀ for every symmetric P and every K.
; Control: a planted fault, the sign of KΣKᵀ, is refuted
; Size: 2 states and 1 reading, over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const a11 Real)
(declare-const a12 Real)
(declare-const a21 Real)
(declare-const a22 Real)
(declare-const h11 Real)
(declare-const h12 Real)
(declare-const q11 Real)
(declare-const q12 Real)
(declare-const q22 Real)
(declare-const c1 Real)
(declare-const c2 Real)
(declare-const r Real)
(declare-const p11 Real)
(declare-const p12 Real)
(declare-const p22 Real)
(declare-const k1 Real)
(declare-const k2 Real)
; the conclusion, denied
(assert (not (and (= (+ (- (- (+ (+ (* (+ (* (- a11 (* k1 h11)) p11) (* (- a12 (* k1 h12)) p12)) (- a11 (* k1 h11))) (* (+ (* (- a11 (* k1 h11)) p12) (* (- a12 (* k1 h12)) p22)) (- a12 (* k1 h12)))) q11) (* k1 c1)) (* c1 k1)) (* (* k1 r) k1)) (- (- (- (+ (+ (* (+ (* a11 p11) (* a12 p12)) a11) (* (+ (* a11 p12) (* a12 p22)) a12)) q11) (* k1 (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1))) (* (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1) k1)) (* (* k1 (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) r)) k1))) (= (+ (- (- (+ (+ (* (+ (* (- a11 (* k1 h11)) p11) (* (- a12 (* k1 h12)) p12)) (- a21 (* k2 h11))) (* (+ (* (- a11 (* k1 h11)) p12) (* (- a12 (* k1 h12)) p22)) (- a22 (* k2 h12)))) q12) (* k1 c2)) (* c1 k2)) (* (* k1 r) k2)) (- (- (- (+ (+ (* (+ (* a11 p11) (* a12 p12)) a21) (* (+ (* a11 p12) (* a12 p22)) a22)) q12) (* k1 (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2))) (* (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1) k2)) (* (* k1 (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) r)) k2))) (= (+ (- (- (+ (+ (* (+ (* (- a21 (* k2 h11)) p11) (* (- a22 (* k2 h12)) p12)) (- a11 (* k1 h11))) (* (+ (* (- a21 (* k2 h11)) p12) (* (- a22 (* k2 h12)) p22)) (- a12 (* k1 h12)))) q12) (* k2 c1)) (* c2 k1)) (* (* k2 r) k1)) (- (- (- (+ (+ (* (+ (* a21 p11) (* a22 p12)) a11) (* (+ (* a21 p12) (* a22 p22)) a12)) q12) (* k2 (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1))) (* (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2) k1)) (* (* k2 (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) r)) k1))) (= (+ (- (- (+ (+ (* (+ (* (- a21 (* k2 h11)) p11) (* (- a22 (* k2 h12)) p12)) (- a21 (* k2 h11))) (* (+ (* (- a21 (* k2 h11)) p12) (* (- a22 (* k2 h12)) p22)) (- a22 (* k2 h12)))) q22) (* k2 c2)) (* c2 k2)) (* (* k2 r) k2)) (- (- (- (+ (+ (* (+ (* a21 p11) (* a22 p12)) a21) (* (+ (* a21 p12) (* a22 p22)) a22)) q22) (* k2 (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2))) (* (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2) k2)) (* (* k2 (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) r)) k2))))))
(check-sat)
