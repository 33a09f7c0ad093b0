; Identifiers: none
; Statement: Joseph's form with C = 1 is at most P, where 1 ≤ P ≤ 2 and R is normal.
; Control: without 1 ≤ P ≤ 2 there is a counter-example
; Size: scalar, binary16
; Expect: sat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
(declare-const r Number)
(define-fun s () Number (fp.add RNE p r))
(define-fun k () Number (fp.div RNE p s))
(define-fun f () Number (fp.sub RNE one k))
(define-fun q () Number (fp.add RNE (fp.mul RNE (fp.mul RNE f p) f) (fp.mul RNE (fp.mul RNE k r) k)))
; R > 0 is normal, S finite
(assert (and (fp.isNormal r) (fp.isPositive r) (and (not (fp.isNaN s)) (not (fp.isInfinite s)))))
; the conclusion, denied
(assert (not (fp.leq q p)))
(check-sat)
