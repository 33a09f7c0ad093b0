; Identifiers: none
; Statement: Joseph's form is a number that is not negative, for every sensor, where S is normal and K, KC and (1 − KC)P are finite.
; Control: the hypothesis the first product is finite is needless
; Size: scalar, binary16
; Expect: unsat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
(declare-const r Number)
(declare-const c Number)
(define-fun s () Number (fp.add RNE (fp.mul RNE (fp.mul RNE c p) c) r))
(define-fun k () Number (fp.div RNE (fp.mul RNE p c) s))
(define-fun f () Number (fp.sub RNE one (fp.mul RNE k c)))
(define-fun q () Number (fp.add RNE (fp.mul RNE (fp.mul RNE f p) f) (fp.mul RNE (fp.mul RNE k r) k)))
; p is finite and not negative
(assert (and (and (not (fp.isNaN p)) (not (fp.isInfinite p))) (fp.leq zero p)))
; r is finite and not negative
(assert (and (and (not (fp.isNaN r)) (not (fp.isInfinite r))) (fp.leq zero r)))
; c is finite
(assert (and (not (fp.isNaN c)) (not (fp.isInfinite c))))
; S is normal, K finite
(assert (and (fp.isNormal s) (and (not (fp.isNaN k)) (not (fp.isInfinite k))) (and (not (fp.isNaN (fp.mul RNE k c))) (not (fp.isInfinite (fp.mul RNE k c))))))
; the conclusion, denied
(assert (not (fp.leq zero q)))
(check-sat)
