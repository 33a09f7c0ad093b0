(** * One-step prediction from a start of any law

    The statistics of SM for a system x₊ = A x + w, y = H x + v with noise of covariance ((Σʷ, Σʷᵛ), (Σᵛʷ, Σᵛ)) that may
    change with time, started at t = 0:

      P, Q, R        the covariance of the errors, its cross block and the covariance of B̃ (2.1, 2.3, 2.4)
      M, Psi         the information of the readings on ξ and the transition of the start (3.20, 1.7)
      Qs, Rs         Q + Ψ and M − R, the slope and the precision (4.1)

    These are identities over any field; the order is needed only at the end. Source: SM, sections 1 to 4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import GRing.Theory.
Local Open Scope ring_scope.

Section Statistics.
Variables (F : fieldType) (n k : nat).
Variables (A : nat -> 'M[F]_n) (H : nat -> 'M[F]_(k, n)).
Variables (Sw : nat -> 'M[F]_n) (Swv : nat -> 'M[F]_(n, k)) (Sv : nat -> 'M[F]_k).

(** What is computed, at t = 0 and from t to t + 1. *)
Fixpoint P t : 'M[F]_n :=
  if t is s.+1 then
    let G := A s *m P s *m (H s)^T + Swv s in
    A s *m P s *m (A s)^T - G *m invmx (H s *m P s *m (H s)^T + Sv s) *m G^T + Sw s
  else 0.
Definition J t : 'M[F]_k := H t *m P t *m (H t)^T + Sv t.
Definition G t : 'M[F]_(n, k) := A t *m P t *m (H t)^T + Swv t.
Fixpoint Psi t : 'M[F]_n := if t is s.+1 then (A s - Swv s *m invmx (Sv s) *m H s) *m Psi s else 1%:M.
Fixpoint Q t : 'M[F]_n :=
  if t is s.+1 then
    A s *m Q s - G s *m invmx (J s) *m H s *m (Q s + Psi s) + Swv s *m invmx (Sv s) *m H s *m Psi s
  else 0.
Fixpoint Rm t : 'M[F]_n :=
  if t is s.+1 then
    Rm s - (Q s + Psi s)^T *m (H s)^T *m invmx (J s) *m H s *m (Q s + Psi s)
      + (Psi s)^T *m (H s)^T *m invmx (Sv s) *m H s *m Psi s
  else 0.
Definition M t : 'M[F]_n := \sum_(s < t) (Psi s)^T *m (H s)^T *m invmx (Sv s) *m H s *m Psi s.
Definition Qs t : 'M[F]_n := Q t + Psi t.
Definition Rs t : 'M[F]_n := M t - Rm t.

(** The recursion that defines P, with J and G named. *)
Theorem covariance_step t : P t.+1 = A t *m P t *m (A t)^T - G t *m invmx (J t) *m (G t)^T + Sw t.
Proof. by []. Qed.

(** SM-4.5: M₊ = M + ΨᵀHᵀ(Σᵛ)⁻¹HΨ, for M as a sum. *)
Theorem information_step t : M t.+1 = M t + (Psi t)^T *m (H t)^T *m invmx (Sv t) *m H t *m Psi t.
Proof. by rewrite /M big_ord_recr. Qed.

(** SM-4.6: from (2.3) and (1.7), Q₊ = (A − GJ⁻¹H)Q. *)
Theorem slope_step t : Qs t.+1 = (A t - G t *m invmx (J t) *m H t) *m Qs t.
Proof. by rewrite /Qs /=; expand. Qed.

(** SM-4.6: Q*(0) = I. *)
Theorem slope_start : Qs 0 = 1%:M.
Proof. by rewrite /Qs /= add0r. Qed.

(** SM-4.7: from (2.4) with the inverse of Σᵛ, R₊ = R + QᵀHᵀJ⁻¹HQ. *)
Theorem precision_step t : Rs t.+1 = Rs t + (Qs t)^T *m (H t)^T *m invmx (J t) *m H t *m Qs t.
Proof. by rewrite /Rs information_step /Qs /=; sums. Qed.

(** SM-4.7: R*(0) = 0. *)
Theorem precision_start : Rs 0 = 0.
Proof. by rewrite /Rs /M big_ord0 subr0. Qed.

(** The two gains agree at the start. *)
Theorem cross_covariance_first : Swv 0 *m invmx (Sv 0) = G 0 *m invmx (J 0).
Proof. by rewrite /G /J /= !(mulmx0, mul0mx) !add0r. Qed.

(** SM-2.3: Q(1) = 0, whatever the model. *)
Theorem Q_first : Q 1 = 0.
Proof. by rewrite /= -/(G 0) -cross_covariance_first mulmx0 !add0r mulmx1 addNr. Qed.

Section Means.
Variable y : nat -> 'cV[F]_k.

Fixpoint mean t : 'cV[F]_n :=
  if t is s.+1 then (A s - G s *m invmx (J s) *m H s) *m mean s + G s *m invmx (J s) *m y s else 0.
Fixpoint linear t : 'cV[F]_n :=
  if t is s.+1 then
    linear s - (Q s + Psi s)^T *m (H s)^T *m invmx (J s) *m H s *m mean s
      + (Q s + Psi s)^T *m (H s)^T *m invmx (J s) *m y s
  else 0.

(** SM-4.8: B̄₊ = B̄ + Q*ᵀHᵀJ⁻¹(Y − HX̄). *)
Theorem linear_step t :
  linear t.+1 = linear t + (Qs t)^T *m (H t)^T *m invmx (J t) *m (y t - H t *m mean t).
Proof. by rewrite /Qs /=; expand. Qed.

(** SM-4.6: Q* is the slope in the start: X̄ + Q*z follows the predictor with the same gain, for every z. *)
Theorem prediction_given_start (z : 'cV[F]_n) t :
  mean t.+1 + Qs t.+1 *m z =
  A t *m (mean t + Qs t *m z) + G t *m invmx (J t) *m (y t - H t *m (mean t + Qs t *m z)).
Proof. by rewrite slope_step /=; expand. Qed.

End Means.

(** The state and its two parts (3.8, 3.9), for every choice of φ, π and ζ. *)
Section Decomposition.
Variables (xi zeta : 'cV[F]_n) (Wo : nat -> 'cV[F]_n) (Vo : nat -> 'cV[F]_k) (f q : nat -> 'cV[F]_n).

Fixpoint state t : 'cV[F]_n := if t is s.+1 then A s *m state s + Wo s else xi.
Definition reading t : 'cV[F]_k := H t *m state t + Vo t.
Fixpoint initial_part t : 'cV[F]_n :=
  if t is s.+1 then (A s - Swv s *m invmx (Sv s) *m H s) *m initial_part s + q s else xi - zeta.
Let C t := Sw t - Swv t *m invmx (Sv t) *m (Swv t)^T.
Definition plant_noise t : 'cV[F]_n := Wo t + Swv t *m invmx (Sv t) *m H t *m initial_part t - C t *m f t.
Fixpoint noise_part t : 'cV[F]_n := if t is s.+1 then A s *m noise_part s + plant_noise s + C s *m f s - q s else zeta.

(** SM-2.16, SM-B1: X° = X + Z, for every choice of φ, π and ζ in (3.8) and (3.9). *)
Theorem parts_add_up t : state t = noise_part t + initial_part t.
Proof. by elim: t => [|t IH] /=; [rewrite addrC subrK | rewrite IH /plant_noise; expand]. Qed.

(** SM-2.19: Y = HX + V with V = V° + HZ. *)
Theorem reading_of_noise_part t : reading t = H t *m noise_part t + (Vo t + H t *m initial_part t).
Proof. by rewrite /reading parts_add_up; expand. Qed.

(** SM-3.7: X₊ + Z₊ = AX + (A − Σʷᵛ(Σᵛ)⁻¹H)Z + W + Cφ, in the new noise W. *)
Theorem state_in_new_noise t : noise_part t.+1 + initial_part t.+1 =
  A t *m noise_part t + (A t - Swv t *m invmx (Sv t) *m H t) *m initial_part t + plant_noise t + C t *m f t.
Proof. by rewrite /=; expand. Qed.

(** SM-3.4: V = V° + HZ forces φᵛ = −(Σᵛ)⁻¹(Σᵛʷφ + HZ). *)
Theorem shift_of_readings t (fv : 'cV[F]_k) : Sv t \in unitmx ->
  Vo t - ((Swv t)^T *m f t + Sv t *m fv) = Vo t + H t *m initial_part t <->
  fv = - (invmx (Sv t) *m ((Swv t)^T *m f t + H t *m initial_part t)).
Proof.
move=> uS; split=> [/addrI/eqP e|->]; last by rewrite mulmxN mulKVmx //; sums.
move: e; rewrite eqr_oppLR => /eqP e.
have e2 : Sv t *m fv = - ((Swv t)^T *m f t + H t *m initial_part t) by rewrite opprD -e addKr.
by rewrite -mulmxN -e2 mulKmx.
Qed.

End Decomposition.

(** SM-Z: with the choice (3.10) the initial part is Z = Ψξ. *)
Theorem initial_part_solved (xi : 'cV[F]_n) t : initial_part xi 0 (fun=> 0) t = Psi t *m xi.
Proof. by elim: t => [|t /= ->]; rewrite /= ?subr0 ?mul1mx // addr0 mulmxA. Qed.

Section Exponent.
Variables (xi : 'cV[F]_n) (Vo : nat -> 'cV[F]_k).
Let Z t := Psi t *m xi.
Let V t := Vo t + H t *m Z t.
Definition statistic T : 'cV[F]_n := \sum_(s < T) (Psi s)^T *m (H s)^T *m invmx (Sv s) *m V s.
Definition inverse_exponent T : 'M[F]_1 :=
  \sum_(s < T) ((Z s)^T *m (H s)^T *m invmx (Sv s) *m Vo s
    + 2%:R^-1 *: ((Z s)^T *m (H s)^T *m invmx (Sv s) *m H s *m Z s)).

(** SM-4.11: B₊ = B + ΨᵀHᵀ(Σᵛ)⁻¹V, for B as a sum. *)
Theorem statistic_step T : statistic T.+1 = statistic T + (Psi T)^T *m (H T)^T *m invmx (Sv T) *m V T.
Proof. by rewrite /statistic big_ord_recr. Qed.

(** SM-3.18: the exponent of L⁻¹ in (3.17), with the old noise and +½, is ξᵀB − ½ξᵀMξ. *)
Theorem exponent_by_B_and_M T : 2%:R != 0 :> F ->
  inverse_exponent T = xi^T *m statistic T - 2%:R^-1 *: (xi^T *m M T *m xi).
Proof.
move=> two; rewrite /inverse_exponent /statistic /M mulmx_sumr mulmx_sumr mulmx_suml scaler_sumr -sumrB.
by apply: eq_bigr => s _; rewrite /V /Z; multiply; entries; field.
Qed.

End Exponent.

End Statistics.

(** SM-4.3: the estimate with Δ⁻¹ is the one without: (R + Δ⁻¹)⁻¹(B + Δ⁻¹μ) = (I + ΔR)⁻¹(ΔB + μ), R and B with their star and bar. *)
Theorem inverse_free_estimate (F : fieldType) n (Delta R : 'M[F]_n) (B mu : 'cV[F]_n) :
  Delta \in unitmx -> 1%:M + Delta *m R \in unitmx ->
  invmx (R + invmx Delta) *m (B + invmx Delta *m mu) = invmx (1%:M + Delta *m R) *m (Delta *m B + mu).
Proof.
move=> uD uS.
have e : R + invmx Delta = invmx Delta *m (1%:M + Delta *m R) by rewrite mulmxDr mulmx1 mulKmx // addrC.
have uE : R + invmx Delta \in unitmx by rewrite e unitmx_mul unitmx_inv uD.
apply: (can_inj (mulKmx uE)); rewrite mulKVmx // {1}e -mulmxA mulKVmx //.
by rewrite mulmxDr mulKmx.
Qed.
