; Identifiers: none
; Statement: 1/(Y + (CW)C) with W = 1/R lies between 0 and 1/Y, for a belief Y > 0 of the information form: no reading makes its own variance larger.
; Control: the hypotheses and the conclusion hold together somewhere
; Size: scalar, binary16
; Expect: sat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const y Number)
(declare-const r Number)
(declare-const c Number)
(define-fun w () Number (fp.div RNE one r))
(define-fun t () Number (fp.add RNE y (fp.mul RNE (fp.mul RNE c w) c)))
; Y > 0 is finite
(assert (and (and (not (fp.isNaN y)) (not (fp.isInfinite y))) (fp.lt zero y)))
; R > 0
(assert (fp.lt zero r))
; c is finite
(assert (and (not (fp.isNaN c)) (not (fp.isInfinite c))))
; (CW)C is a number
(assert (not (fp.isNaN t)))
; the conclusion
(assert (and (fp.leq zero (fp.div RNE one t)) (fp.leq (fp.div RNE one t) (fp.div RNE one y))))
(check-sat)
