; Identifiers: EK-L6
; Statement: |eᵢⱼ| ≤ cᵢⱼsᵢsⱼ ⇒ −D ≤ e ≤ D, D = diag(sᵢ² Σⱼ cᵢⱼ).
; Control: without |e12| is bounded there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const e11 Real)
(declare-const e12 Real)
(declare-const e22 Real)
(declare-const c11 Real)
(declare-const c12 Real)
(declare-const c22 Real)
(declare-const s1 Real)
(declare-const s2 Real)
; scales are positive
(assert (and (> s1 0) (> s2 0)))
; |e11| is bounded
(assert (and (<= e11 (* c11 s1 s1)) (<= (- (* c11 s1 s1)) e11)))
; |e22| is bounded
(assert (and (<= e22 (* c22 s2 s2)) (<= (- (* c22 s2 s2)) e22)))
; the conclusion, denied
(assert (not (and (and (>= (- (* (* s1 s1) (+ c11 c12)) e11) 0) (>= (- (* (* s2 s2) (+ c12 c22)) e22) 0) (>= (- (* (- (* (* s1 s1) (+ c11 c12)) e11) (- (* (* s2 s2) (+ c12 c22)) e22)) (* (- e12) (- e12))) 0)) (and (>= (+ (* (* s1 s1) (+ c11 c12)) e11) 0) (>= (+ (* (* s2 s2) (+ c12 c22)) e22) 0) (>= (- (* (+ (* (* s1 s1) (+ c11 c12)) e11) (+ (* (* s2 s2) (+ c12 c22)) e22)) (* e12 e12)) 0)))))
(check-sat)
