; Identifiers: none
; Statement: 1/(1/P) is at most P, where 1 ≤ P ≤ 2. It is refuted: what the information form hands out before it has read anything.
; Control: what one would like to be true has a counter-example
; Size: scalar, binary16
; Expect: sat
(set-logic QF_FP)
(define-sort Number () Float16)
(define-fun zero () Number (_ +zero 5 11))
(define-fun one () Number ((_ to_fp 5 11) RNE 1.0))
(declare-const p Number)
; 1 ≤ P ≤ 2
(assert (and (fp.leq one p) (fp.leq p (fp.add RNE one one))))
; the conclusion, denied
(assert (not (fp.leq (fp.div RNE one (fp.div RNE one p)) p)))
(check-sat)
