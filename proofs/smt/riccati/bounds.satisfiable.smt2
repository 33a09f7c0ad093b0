; Identifiers: AK-4.2
; Statement: 0 ≤ S:W ≤ W for S, W ≥ 0 with S + W > 0: the bounds V ≤ φ(S) ≤ AWAᵀ + V before A(·)Aᵀ + V is made of them.
; Control: the hypotheses and the conclusion hold together somewhere
; Size: 2×2 over the reals
; Expect: sat
; Multiplied by d = det(S + W) > 0: what A(·)Aᵀ + V is made of.
(set-logic QF_NRA)
(declare-const s11 Real)
(declare-const s12 Real)
(declare-const s22 Real)
(declare-const w11 Real)
(declare-const w12 Real)
(declare-const w22 Real)
(define-fun d () Real (- (* (+ s11 w11) (+ s22 w22)) (* (+ s12 w12) (+ s12 w12))))
(define-fun n11 () Real (+ (* (+ (* s11 (+ s22 w22)) (* s12 (- (+ s12 w12)))) w11) (* (+ (* s11 (- (+ s12 w12))) (* s12 (+ s11 w11))) w12)))
(define-fun n12 () Real (+ (* (+ (* s11 (+ s22 w22)) (* s12 (- (+ s12 w12)))) w12) (* (+ (* s11 (- (+ s12 w12))) (* s12 (+ s11 w11))) w22)))
(define-fun n21 () Real (+ (* (+ (* s12 (+ s22 w22)) (* s22 (- (+ s12 w12)))) w11) (* (+ (* s12 (- (+ s12 w12))) (* s22 (+ s11 w11))) w12)))
(define-fun n22 () Real (+ (* (+ (* s12 (+ s22 w22)) (* s22 (- (+ s12 w12)))) w12) (* (+ (* s12 (- (+ s12 w12))) (* s22 (+ s11 w11))) w22)))
; S ≥ 0
(assert (and (>= s11 0) (>= s22 0) (>= (- (* s11 s22) (* s12 s12)) 0)))
; W ≥ 0
(assert (and (>= w11 0) (>= w22 0) (>= (- (* w11 w22) (* w12 w12)) 0)))
; the conclusion
(assert (and (and (>= n11 0) (>= n22 0) (>= (- (* n11 n22) (* n12 n21)) 0)) (and (>= (- (* d w11) n11) 0) (>= (- (* d w22) n22) 0) (>= (- (* (- (* d w11) n11) (- (* d w22) n22)) (* (- (* d w12) n12) (- (* d w12) n21))) 0))))
(check-sat)
