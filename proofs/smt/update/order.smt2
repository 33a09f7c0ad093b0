; Identifiers: EK-L4
; Statement: φ(P′) − φ(P) ≤ (A − KH)(P′ − P)(A − KH)ᵀ, K the gain at P: one half of the second line.
; Size: 2 states and 1 reading, over the reals
; Expect: unsat
; Multiplied by Σ²Σ′ > 0, for every x. The difference is (KΣ′ − Γ′)Σ′⁻¹(KΣ′ − Γ′)ᵀ.
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
(declare-const o11 Real)
(declare-const o12 Real)
(declare-const o22 Real)
(declare-const x1 Real)
(declare-const x2 Real)
(define-fun g1 () Real (+ (+ (* (+ (* a11 p11) (* a12 p12)) h11) (* (+ (* a11 p12) (* a12 p22)) h12)) c1))
(define-fun g2 () Real (+ (+ (* (+ (* a21 p11) (* a22 p12)) h11) (* (+ (* a21 p12) (* a22 p22)) h12)) c2))
(define-fun s () Real (+ (+ (* (+ (* h11 p11) (* h12 p12)) h11) (* (+ (* h11 p12) (* h12 p22)) h12)) r))
(define-fun f1 () Real (+ (+ (* (+ (* a11 o11) (* a12 o12)) h11) (* (+ (* a11 o12) (* a12 o22)) h12)) c1))
(define-fun f2 () Real (+ (+ (* (+ (* a21 o11) (* a22 o12)) h11) (* (+ (* a21 o12) (* a22 o22)) h12)) c2))
(define-fun t () Real (+ (+ (* (+ (* h11 o11) (* h12 o12)) h11) (* (+ (* h11 o12) (* h12 o22)) h12)) r))
; Σ′ > 0
(assert (> t 0))
; the conclusion, denied
(assert (not (<= (+ (* (+ (* x1 (- (- (* s (* s (* t (+ (+ (* (+ (* a11 o11) (* a12 o12)) a11) (* (+ (* a11 o12) (* a12 o22)) a12)) q11)))) (* (* s s) (* f1 f1))) (- (* s (* s (* t (+ (+ (* (+ (* a11 p11) (* a12 p12)) a11) (* (+ (* a11 p12) (* a12 p22)) a12)) q11)))) (* (* s t) (* g1 g1))))) (* x2 (- (- (* s (* s (* t (+ (+ (* (+ (* a21 o11) (* a22 o12)) a11) (* (+ (* a21 o12) (* a22 o22)) a12)) q12)))) (* (* s s) (* f2 f1))) (- (* s (* s (* t (+ (+ (* (+ (* a21 p11) (* a22 p12)) a11) (* (+ (* a21 p12) (* a22 p22)) a12)) q12)))) (* (* s t) (* g2 g1)))))) x1) (* (+ (* x1 (- (- (* s (* s (* t (+ (+ (* (+ (* a11 o11) (* a12 o12)) a21) (* (+ (* a11 o12) (* a12 o22)) a22)) q12)))) (* (* s s) (* f1 f2))) (- (* s (* s (* t (+ (+ (* (+ (* a11 p11) (* a12 p12)) a21) (* (+ (* a11 p12) (* a12 p22)) a22)) q12)))) (* (* s t) (* g1 g2))))) (* x2 (- (- (* s (* s (* t (+ (+ (* (+ (* a21 o11) (* a22 o12)) a21) (* (+ (* a21 o12) (* a22 o22)) a22)) q22)))) (* (* s s) (* f2 f2))) (- (* s (* s (* t (+ (+ (* (+ (* a21 p11) (* a22 p12)) a21) (* (+ (* a21 p12) (* a22 p22)) a22)) q22)))) (* (* s t) (* g2 g2)))))) x2)) (+ (* (+ (* x1 (* t (+ (* (+ (* (- (* s a11) (* g1 h11)) (- o11 p11)) (* (- (* s a12) (* g1 h12)) (- o12 p12))) (- (* s a11) (* g1 h11))) (* (+ (* (- (* s a11) (* g1 h11)) (- o12 p12)) (* (- (* s a12) (* g1 h12)) (- o22 p22))) (- (* s a12) (* g1 h12)))))) (* x2 (* t (+ (* (+ (* (- (* s a21) (* g2 h11)) (- o11 p11)) (* (- (* s a22) (* g2 h12)) (- o12 p12))) (- (* s a11) (* g1 h11))) (* (+ (* (- (* s a21) (* g2 h11)) (- o12 p12)) (* (- (* s a22) (* g2 h12)) (- o22 p22))) (- (* s a12) (* g1 h12))))))) x1) (* (+ (* x1 (* t (+ (* (+ (* (- (* s a11) (* g1 h11)) (- o11 p11)) (* (- (* s a12) (* g1 h12)) (- o12 p12))) (- (* s a21) (* g2 h11))) (* (+ (* (- (* s a11) (* g1 h11)) (- o12 p12)) (* (- (* s a12) (* g1 h12)) (- o22 p22))) (- (* s a22) (* g2 h12)))))) (* x2 (* t (+ (* (+ (* (- (* s a21) (* g2 h11)) (- o11 p11)) (* (- (* s a22) (* g2 h12)) (- o12 p12))) (- (* s a21) (* g2 h11))) (* (+ (* (- (* s a21) (* g2 h11)) (- o12 p12)) (* (- (* s a22) (* g2 h12)) (- o22 p22))) (- (* s a22) (* g2 h12))))))) x2)))))
(check-sat)
