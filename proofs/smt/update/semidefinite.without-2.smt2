; Identifiers: none
; Statement: P − PCᵀ(CPCᵀ + R)⁻¹CP is positive semidefinite and at most P, for P ≥ 0, R ≥ 0 and CPCᵀ + R > 0 (no shared noise).
; Control: without R ≥ 0 there is a counter-example
; Size: 2 states and 1 reading, over the reals
; Expect: sat
; n is S(P − PCᵀS⁻¹CP), S = CPCᵀ + R.
(set-logic QF_NRA)
(declare-const p11 Real)
(declare-const p12 Real)
(declare-const p22 Real)
(declare-const c11 Real)
(declare-const c12 Real)
(declare-const r Real)
(define-fun s () Real (+ (+ (* (+ (* c11 p11) (* c12 p12)) c11) (* (+ (* c11 p12) (* c12 p22)) c12)) r))
(define-fun n11 () Real (- (* s p11) (+ (* (* (+ (* p11 c11) (* p12 c12)) c11) p11) (* (* (+ (* p11 c11) (* p12 c12)) c12) p12))))
(define-fun n12 () Real (- (* s p12) (+ (* (* (+ (* p11 c11) (* p12 c12)) c11) p12) (* (* (+ (* p11 c11) (* p12 c12)) c12) p22))))
(define-fun n21 () Real (- (* s p12) (+ (* (* (+ (* p12 c11) (* p22 c12)) c11) p11) (* (* (+ (* p12 c11) (* p22 c12)) c12) p12))))
(define-fun n22 () Real (- (* s p22) (+ (* (* (+ (* p12 c11) (* p22 c12)) c11) p12) (* (* (+ (* p12 c11) (* p22 c12)) c12) p22))))
; P ≥ 0
(assert (and (>= p11 0) (>= p22 0) (>= (- (* p11 p22) (* p12 p12)) 0)))
; S is regular
(assert (distinct s 0))
; the conclusion, denied
(assert (not (and (and (>= n11 0) (>= n22 0) (>= (- (* n11 n22) (* n12 n21)) 0)) (and (>= (- (* s p11) n11) 0) (>= (- (* s p22) n22) 0) (>= (- (* (- (* s p11) n11) (- (* s p22) n22)) (* (- (* s p12) n12) (- (* s p12) n21))) 0)))))
(check-sat)
