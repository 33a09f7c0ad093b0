; Identifiers: none
; Statement: ρ(D) < 1 and X = DXDᵀ ⇒ X = 0, for symmetric X: a solution of Stein's equation is the only one.
; Control: without det D < 1 there is a counter-example
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
; tr D < 1 + det D
(assert (< (+ d11 d22) (+ 1 (- (* d11 d22) (* d12 d21)))))
; −tr D < 1 + det D
(assert (< (- (+ d11 d22)) (+ 1 (- (* d11 d22) (* d12 d21)))))
; X = DXDᵀ
(assert (and (= x11 (+ (* (+ (* d11 x11) (* d12 x12)) d11) (* (+ (* d11 x12) (* d12 x22)) d12))) (= x12 (+ (* (+ (* d11 x11) (* d12 x12)) d21) (* (+ (* d11 x12) (* d12 x22)) d22))) (= x12 (+ (* (+ (* d21 x11) (* d22 x12)) d11) (* (+ (* d21 x12) (* d22 x22)) d12))) (= x22 (+ (* (+ (* d21 x11) (* d22 x12)) d21) (* (+ (* d21 x12) (* d22 x22)) d22)))))
; the conclusion, denied
(assert (not (and (= x11 0) (= x12 0) (= x12 0) (= x22 0))))
(check-sat)
