; Identifiers: AK-Ex4
; Statement: A = 2I, V = diag(0, 1), W = diag(1, 0): every S ≥ 0 with S + W > 0 and S = φ(S) is V + tW with t = 0 or t = 3.
; Control: without S = φ(S) there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const s11 Real)
(declare-const s12 Real)
(declare-const s22 Real)
(define-fun d () Real (- (* (+ s11 1) s22) (* s12 s12)))
; S ≥ 0
(assert (and (>= s11 0) (>= s22 0) (>= (- (* s11 s22) (* s12 s12)) 0)))
; S + W is regular
(assert (distinct d 0))
; the conclusion, denied
(assert (not (and (= s22 1) (= s12 0) (or (= s11 0) (= s11 3)))))
(check-sat)
