(** * Certificates of a steady state

    The step of [Enclosure] with a square A: a set of covariances within E of S̃ that is mapped into itself.

    The existence of a fixed point is not here: it is a limit, and in general no rational number.
    Source: EK-T5. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing PositiveSemidefinite PseudoInverse Joint Gaps Enclosure Certificate.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section SelfMap.
Variables (R : realFieldType) (n p : nat).
Variables (A : 'M[R]_n) (H : 'M[R]_(p, n)) (Q : 'M[R]_n) (S : 'M[R]_(n, p)) (V : 'M[R]_p).
Variables (T : 'M[R]_p) (St E : 'M[R]_n) (K : 'M[R]_(n, p)) (eta w : R).
Hypotheses (symV : V^T = V) (symSt : St^T = St).
Hypothesis eta_row : forall i, \sum_j `|(T *m Sigma H V St *m T^T - 1%:M) i j| <= eta.
Hypothesis w_trace : \tr (T *m (H *m E *m H^T) *m T^T) <= w.
Let kappa := 1 - eta - w.
Hypothesis kappa_gt0 : 0 < kappa.
Let C := closed A H K.
Let rho := K *m Sigma H V St - Gamma A H S St.
Let W := (1 + 2%:R * w / kappa) *: (C *m E *m C^T) + (2%:R / kappa) *: (rho *m T^T *m T *m rho^T).
Hypothesis certificate : within (E - W) (joseph A H Q S V St K - St).

(** EK-T5: φ maps {P : −E ⪯ P − S̃ ⪯ E} into itself, and Σ is definite on it; that a fixed point is there needs limits. *)
Theorem maps_into_itself P : within E (P - St) ->
  within E (phi A H Q S V P - St) /\ pd (Sigma H V P).
Proof.
move=> gap; split; last exact: innovation_pd gap eta_row w_trace kappa_gt0.
have h : within W (phi A H Q S V P - joseph A H Q S V St K).
  exact: enclosed_covariance symV symSt gap eta_row w_trace kappa_gt0.
have := withinD h certificate; have -> : W + (E - W) = E by rewrite addrC subrK.
by rewrite addrA subrK.
Qed.

End SelfMap.
