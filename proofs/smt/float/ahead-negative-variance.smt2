; Identifiers: none
; Statement: P − (KS)K with K = P(1/S) and S = P + R is not negative where nothing is subnormal or overflows. It is refuted: what is predicted of the next state (A = 1, Q = 0) by the forms textbook, symmetrised and pseudo-inverse.
; Control: what one would like to be true has a counter-example
; Size: scalar, binary16
; Expect: sat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
(declare-const r Number)
(define-fun s () Number (fp.add RNE p r))
(define-fun w () Number (fp.div RNE one s))
(define-fun k () Number (fp.mul RNE p w))
(define-fun q () Number (fp.mul RNE (fp.sub RNE one k) p))
(define-fun n () Number (fp.sub RNE p (fp.mul RNE (fp.mul RNE k s) k)))
; p is finite and not negative
(assert (and (and (not (fp.isNaN p)) (not (fp.isInfinite p))) (fp.leq zero p)))
; r is finite and not negative
(assert (and (and (not (fp.isNaN r)) (not (fp.isInfinite r))) (fp.leq zero r)))
; 1 ≤ P ≤ 2
(assert (and (fp.leq one p) (fp.leq p (fp.add RNE one one))))
; R > 0 is normal
(assert (and (fp.isNormal r) (fp.isPositive r)))
; the conclusion, denied
(assert (not (fp.leq zero n)))
(check-sat)
