; Identifiers: none
; Statement: P(R/S) with S = R + C(PC) lies between 0 and P, for every sensor, where S is finite and not zero: form ud, in all of the range, subnormal numbers included.
; Size: scalar, binary16
; Expect: unsat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
(declare-const r Number)
(declare-const c Number)
(define-fun s () Number (fp.add RNE r (fp.mul RNE c (fp.mul RNE p c))))
(define-fun q () Number (fp.mul RNE p (fp.div RNE r s)))
; p is finite and not negative
(assert (and (and (not (fp.isNaN p)) (not (fp.isInfinite p))) (fp.leq zero p)))
; r is finite and not negative
(assert (and (and (not (fp.isNaN r)) (not (fp.isInfinite r))) (fp.leq zero r)))
; c is finite
(assert (and (not (fp.isNaN c)) (not (fp.isInfinite c))))
; S is finite
(assert (and (not (fp.isNaN s)) (not (fp.isInfinite s))))
; S is not zero
(assert (not (fp.isZero s)))
; the conclusion, denied
(assert (not (and (fp.leq zero q) (fp.leq q p))))
(check-sat)
