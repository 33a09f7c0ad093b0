; Identifiers: none
; Statement: (1 − K)P with K = P(1/S), S = P + R and C = 1 lies between 0 and P: forms textbook, symmetrised and pseudo-inverse.
; Control: without 1/S is normal there is a counter-example
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
; p is finite and not negative
(assert (and (and (not (fp.isNaN p)) (not (fp.isInfinite p))) (fp.leq zero p)))
; r is finite and not negative
(assert (and (and (not (fp.isNaN r)) (not (fp.isInfinite r))) (fp.leq zero r)))
; S is finite and normal
(assert (fp.isNormal s))
; the conclusion, denied
(assert (not (and (fp.leq zero q) (fp.leq q p))))
(check-sat)
