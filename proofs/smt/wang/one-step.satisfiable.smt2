; Identifiers: WG-55
; Statement: One step of the bound: |F(1 − LH)|² ≤ (1 − 1/(1 + Q̄⁻¹P(k+1))) P(k+1) P⁻¹(k).
; Control: the hypotheses and the conclusion hold together somewhere
; Size: scalar, over the reals
; Expect: sat
; g = F(1 − LH), n = P(k+1) = g²P + Q̄ (WG-52). Multiplied by P(Q̄ + n) > 0: 1 − 1/(1 + n/Q̄) = n/(Q̄ + n).
(set-logic QF_NRA)
(declare-const g Real)
(declare-const p Real)
(declare-const q Real)
(define-fun n () Real (+ (* g g p) q))
; P(k) > 0
(assert (> p 0))
; Q̄ > 0
(assert (> q 0))
; the conclusion
(assert (<= (* g g p (+ q n)) (* n n)))
(check-sat)
