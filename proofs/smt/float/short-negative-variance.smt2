; Identifiers: none
; Statement: (1 − KC)P with K = (PC)(1/S) is not negative for C ≤ 2 where nothing is subnormal or overflows. It is refuted: forms textbook, symmetrised and pseudo-inverse.
; Control: what one would like to be true has a counter-example
; Size: scalar, binary16
; Expect: sat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
(declare-const r Number)
(declare-const c Number)
(define-fun s () Number (fp.add RNE (fp.mul RNE (fp.mul RNE c p) c) r))
(define-fun w () Number (fp.div RNE one s))
(define-fun k () Number (fp.mul RNE (fp.mul RNE p c) w))
(define-fun q () Number (fp.mul RNE (fp.sub RNE one (fp.mul RNE k c)) p))
; p is finite and not negative
(assert (and (and (not (fp.isNaN p)) (not (fp.isInfinite p))) (fp.leq zero p)))
; r is finite and not negative
(assert (and (and (not (fp.isNaN r)) (not (fp.isInfinite r))) (fp.leq zero r)))
; c is finite
(assert (and (not (fp.isNaN c)) (not (fp.isInfinite c))))
; 1 ≤ P, C ≤ 2
(assert (and (fp.leq one p) (fp.leq one c) (fp.leq p (fp.add RNE one one)) (fp.leq c (fp.add RNE one one))))
; R > 0 is normal
(assert (and (fp.isNormal r) (fp.isPositive r)))
; the conclusion, denied
(assert (not (fp.leq zero q)))
(check-sat)
