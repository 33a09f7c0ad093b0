; Identifiers: EK-L4
; Statement: P ≤ P′ ⇒ P − PCᵀ(CPCᵀ + R)⁻¹CP ≤ P′ − P′Cᵀ(CP′Cᵀ + R)⁻¹CP′, for P ≥ 0, R > 0: the first line, with A = I and S = 0.
; Control: without P ≥ 0 there is a counter-example
; Size: 2 states and 1 reading, over the reals
; Expect: sat
; C = [1 0], which any nonzero C is in a suitable basis. E = P′ − P.
(set-logic QF_NRA)
(declare-const p11 Real)
(declare-const p12 Real)
(declare-const p22 Real)
(declare-const e11 Real)
(declare-const e12 Real)
(declare-const e22 Real)
(declare-const r Real)
(define-fun s () Real (+ p11 r))
(define-fun t () Real (+ (+ p11 e11) r))
(define-fun n11 () Real (- (* s p11) (* p11 p11)))
(define-fun n12 () Real (- (* s p12) (* p11 p12)))
(define-fun n21 () Real (- (* s p12) (* p12 p11)))
(define-fun n22 () Real (- (* s p22) (* p12 p12)))
(define-fun m11 () Real (- (* t (+ p11 e11)) (* (+ p11 e11) (+ p11 e11))))
(define-fun m12 () Real (- (* t (+ p12 e12)) (* (+ p11 e11) (+ p12 e12))))
(define-fun m21 () Real (- (* t (+ p12 e12)) (* (+ p12 e12) (+ p11 e11))))
(define-fun m22 () Real (- (* t (+ p22 e22)) (* (+ p12 e12) (+ p12 e12))))
; P′ − P ≥ 0
(assert (and (>= e11 0) (>= e22 0) (>= (- (* e11 e22) (* e12 e12)) 0)))
; R > 0
(assert (> r 0))
; the conclusion, denied
(assert (not (and (>= (- (* s m11) (* t n11)) 0) (>= (- (* s m22) (* t n22)) 0) (>= (- (* (- (* s m11) (* t n11)) (- (* s m22) (* t n22))) (* (- (* s m12) (* t n12)) (- (* s m21) (* t n21)))) 0))))
(check-sat)
