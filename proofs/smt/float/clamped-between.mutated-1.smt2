; Identifiers: none
; Statement: max(0, min(P, (1 − KC)P)) lies between 0 and P where (1 − KC)P is a number: the short form, mended by a clamp.
; Control: a planted fault, without the clamp, is refuted
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
; (1 − KC)P is a number
(assert (not (fp.isNaN q)))
; the conclusion, denied
(assert (not (and (fp.leq zero q) (fp.leq q p))))
(check-sat)
