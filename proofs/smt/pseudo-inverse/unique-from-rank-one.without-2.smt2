; Identifiers: CKS-L3-pinv
; Statement: PXP = P, X = UPᵀ = PᵀV ⇒ X is unique, for P of rank at most one, in coordinates where P = diag(p, 0).
; Control: without X = UPᵀ for some U there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
; An orthogonal change of rows and one of columns bring every P of rank one there.
(set-logic QF_NRA)
(declare-const x11 Real)
(declare-const x12 Real)
(declare-const x21 Real)
(declare-const x22 Real)
(declare-const y11 Real)
(declare-const y12 Real)
(declare-const y21 Real)
(declare-const y22 Real)
(declare-const u11 Real)
(declare-const u12 Real)
(declare-const u21 Real)
(declare-const u22 Real)
(declare-const v11 Real)
(declare-const v12 Real)
(declare-const v21 Real)
(declare-const v22 Real)
(declare-const m11 Real)
(declare-const m12 Real)
(declare-const m21 Real)
(declare-const m22 Real)
(declare-const n11 Real)
(declare-const n12 Real)
(declare-const n21 Real)
(declare-const n22 Real)
(declare-const p Real)
; PXP = P
(assert (and (= (* (* p x11) p) p) (= 0 0) (= 0 0) (= 0 0)))
; X = PᵀV for some V
(assert (and (= x11 (* p v11)) (= x12 (* p v12)) (= x21 0) (= x22 0)))
; PYP = P
(assert (and (= (* (* p y11) p) p) (= 0 0) (= 0 0) (= 0 0)))
; Y = UPᵀ for some U
(assert (and (= y11 (* m11 p)) (= y12 0) (= y21 (* m21 p)) (= y22 0)))
; Y = PᵀV for some V
(assert (and (= y11 (* p n11)) (= y12 (* p n12)) (= y21 0) (= y22 0)))
; the conclusion, denied
(assert (not (and (= x11 y11) (= x12 y12) (= x21 y21) (= x22 y22))))
(check-sat)
