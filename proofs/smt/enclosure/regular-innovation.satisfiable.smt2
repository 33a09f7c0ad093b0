; Identifiers: EK-L7
; Statement: −w ≤ P − P̃ ≤ w, |T²Σ̃ − 1| ≤ η, T²H²w ≤ ω, κ = 1 − η − ω > 0 ⇒ Σ > 0 and κΣ⁻¹ ≤ T².
; Control: the hypotheses and the conclusion hold together somewhere
; Size: 1 state and 1 reading, over the reals
; Expect: sat
(set-logic QF_NRA)
(declare-const p Real)
(declare-const pt Real)
(declare-const h Real)
(declare-const r Real)
(declare-const t Real)
(declare-const eta Real)
(declare-const omega Real)
(declare-const w Real)
(define-fun s () Real (+ (* h p h) r))
(define-fun st () Real (+ (* h pt h) r))
; −w ≤ P − P̃ ≤ w
(assert (and (<= (- w) (- p pt)) (<= (- p pt) w)))
; |T²Σ̃ − 1| ≤ η
(assert (and (<= (- (* t t st) 1) eta) (<= (- 1 (* t t st)) eta)))
; T²H²w ≤ ω
(assert (<= (* t t h h w) omega))
; κ > 0
(assert (< (+ eta omega) 1))
; the conclusion
(assert (and (> s 0) (<= (- 1 eta omega) (* t t s))))
(check-sat)
