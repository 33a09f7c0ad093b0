; Identifiers: none
; Statement: ρ(D) < 1 and X = DXDᵀ ⇒ X = 0, for symmetric X: a solution of Stein's equation is the only one.
; Control: without X = DXDᵀ there is a counter-example
; Size: 2×2 over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const d11 Real)
(declare-const d12 Real)
(declare-const d21 Real)
(declare-const d22 Real)
(declare-const x11 Real)
(declare-const x12 Real)
(declare-const x22 Real)
; det D < 1
(assert (< (- (* d11 d22) (* d12 d21)) 1))
; tr D < 1 + det D
(assert (< (+ d11 d22) (+ 1 (- (* d11 d22) (* d12 d21)))))
; −tr D < 1 + det D
(assert (< (- (+ d11 d22)) (+ 1 (- (* d11 d22) (* d12 d21)))))
; the conclusion, denied
(assert (not (and (= x11 0) (= x12 0) (= x12 0) (= x22 0))))
(check-sat)
