(** * Products of closed loops along random Riccati equations

    On one path nothing is random: F, H, Q, R are any sequences, P(k+1) the image of P(k), L(k) its gain.

      filter_noise Q R   [[Q, 0], [0, R]], uncorrelated noises
      filter_gain        L = PHᵀ(HPHᵀ + R)⁺
      filter_loop        F(I − LH), the closed loop
      filter_load        Q̄ = FLRLᵀFᵀ + Q, what a step adds
      transition M k     M(k−1) ⋯ M(0)

    Norms are written as orders: ‖X‖² ≤ s is X Xᵀ ⪯ s I. Laws and expectations are not treated here.
    Source: WG, (1), (52), (53) and Lemma 2.2. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint Riccati.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Step.
Variables (R : realFieldType) (d m : nat).
Variables (F : 'M[R]_d) (H : 'M[R]_(m, d)) (Q : 'M[R]_d) (V : 'M[R]_m).
Hypotheses (psdQ : psd Q) (psdV : psd V).
Implicit Types P E : 'M[R]_d.

Definition filter_noise : 'M[R]_(d + m) := block_mx Q 0 0 V.
Definition filter_step P := riccati F H filter_noise P.
Definition filter_gain P : 'M[R]_(d, m) := P *m H^T *m (H *m P *m H^T + V)^†.
Definition filter_loop P : 'M[R]_d := F *m (1%:M - filter_gain P *m H).
Definition filter_load P : 'M[R]_d := F *m filter_gain P *m V *m (filter_gain P)^T *m F^T + Q.

Lemma psd_filter_noise : psd filter_noise.
Proof. exact: psd_block_diag. Qed.

Lemma filter_stack P : stack F H filter_noise P =
  block_mx (F *m P *m F^T + Q) (F *m P *m H^T) (H *m P *m F^T) (H *m P *m H^T + V).
Proof. by rewrite stack_blocks add_block_mx !addr0. Qed.

(** WG-53: the gain of the Riccati map is FL. *)
Theorem filter_gainE P : riccati_gain F H filter_noise P = F *m filter_gain P.
Proof. by rewrite /riccati_gain filter_stack gain_block /filter_gain !mulmxA. Qed.

Lemma filter_loopE P : closed F H (riccati_gain F H filter_noise P) = filter_loop P.
Proof. by rewrite filter_gainE /closed /filter_loop mulmxBr mulmx1 mulmxA. Qed.

(** WG-1, WG-71: P₊ = FPFᵀ − FPHᵀ(HPHᵀ + R)⁺HPFᵀ + Q, with a pseudo-inverse where R is singular. *)
Theorem filter_stepE P : filter_step P =
  F *m P *m F^T - F *m P *m H^T *m (H *m P *m H^T + V)^† *m H *m P *m F^T + Q.
Proof. by rewrite /filter_step /riccati filter_stack schur_block !mulmxA addrAC. Qed.

(** WG-52, WG-53: the Lyapunov form P₊ = F(I − LH)P(I − LH)ᵀFᵀ + Q̄ with Q̄ = FLRLᵀFᵀ + Q. *)
Theorem filter_lyapunov P : psd P ->
  filter_step P = filter_loop P *m P *m (filter_loop P)^T + filter_load P.
Proof.
move=> pP; rewrite /filter_step riccati_lyapunov //; last exact: psd_filter_noise.
rewrite filter_loopE filter_gainE /filter_load residual_block; congr (_ + _).
move: (filter_gain P) => L; rewrite !mulmx0 !mul0mx !subr0 (trmx_mul F L) !mulmxA.
by rewrite addrC.
Qed.

Lemma psd_filter_step P : psd P -> psd (filter_step P).
Proof. by apply: riccati_psd; apply: psd_filter_noise. Qed.

(** WG-52: any other gain gives at least as much as that of the filter. *)
Theorem filter_optimal P K : psd P -> filter_step P ⪯ joseph F H filter_noise P K.
Proof. by apply: riccati_upper; apply: psd_filter_noise. Qed.

Lemma psd_filter_load P : psd (filter_load P).
Proof.
rewrite /filter_load; move: (filter_gain P) => L.
apply: psdD => //; have := psd_congruence (F *m L) psdV.
by rewrite (trmx_mul F) !mulmxA.
Qed.

(** What the reading and the state add stays below what is left: FLRLᵀFᵀ ⪯ Q̄ ⪯ P₊. *)
Theorem filter_load_bounds P : psd P ->
  F *m filter_gain P *m V *m (F *m filter_gain P)^T ⪯ filter_load P /\ filter_load P ⪯ filter_step P.
Proof.
move=> pP; split; last first.
  by rewrite filter_lyapunov // addrK; apply: psd_congruence.
rewrite /filter_load; move: (filter_gain P) => L.
by rewrite (trmx_mul F L) !mulmxA addrC addKr.
Qed.

(** Q ⪯ P₊: no covariance falls below the noise of the state. *)
Theorem filter_ge_noise P : psd P -> Q ⪯ filter_step P.
Proof.
move=> pP; have := riccati_ge_noise F H psd_filter_noise pP.
by rewrite schur_block !mul0mx subr0.
Qed.

(** If Q ≻ 0, then P₊⁻¹ ⪯ Q⁻¹. *)
Theorem filter_inverse_bound P : pd Q -> psd P -> invmx (filter_step P) ⪯ invmx Q.
Proof. by move=> pQ pP; apply: pd_inv_antitone => //; apply: filter_ge_noise. Qed.

(** WG-L2.2: one factor of the bound: P₊ ⪯ cQ̄ gives F(I − LH)P(I − LH)ᵀFᵀ ⪯ (1 − 1/c)P₊, the sharp form. *)
Theorem closed_loop_factor P c : psd P -> 0 < c -> filter_step P ⪯ c *: filter_load P ->
  filter_loop P *m P *m (filter_loop P)^T ⪯ (1 - c^-1) *: filter_step P.
Proof.
move=> pP c0 le; have ci : 0 <= c^-1 by rewrite invr_ge0 ltW.
have := loewnerZ ci le; rewrite scalerA mulVf ?gt_eqF // scale1r => h.
have -> : filter_loop P *m P *m (filter_loop P)^T = filter_step P - filter_load P.
  by rewrite filter_lyapunov // addrK.
by rewrite scalerBl scale1r opprB addrC addrA subrK.
Qed.

(** WG-L2.2: one factor as printed: P₊ ⪯ cQ̄ gives F(I − LH)P(I − LH)ᵀFᵀ ⪯ (1 − 1/(1 + c))P₊. *)
Theorem closed_loop_factor_printed P c : psd P -> 0 <= c -> filter_step P ⪯ c *: filter_load P ->
  filter_loop P *m P *m (filter_loop P)^T ⪯ (1 - (1 + c)^-1) *: filter_step P.
Proof.
move=> pP c0 le; apply: closed_loop_factor => //; first by rewrite ltr_paddr ?ltr01.
apply: loewner_trans le _; rewrite -scalerBl addrK scale1r.
exact: psd_filter_load.
Qed.

(** A filter that believes in noise N and covariance P, where in truth N' ⪯ cN and E ⪯ cP, errs after the step by at most cP₊. *)
Theorem wrong_noise (N' : 'M[R]_(d + m)) P E c : psd P -> N' ⪯ c *: filter_noise -> E ⪯ c *: P ->
  joseph F H N' E (riccati_gain F H filter_noise P) ⪯ c *: filter_step P.
Proof.
move=> pP NN EP; rewrite /filter_step (riccati_joseph F H psd_filter_noise pP) -residualZ.
apply: residual_mono; rewrite /stack scalerDr; apply: loewnerD => //.
by have := congruence_mono (col_mx F H) EP; rewrite -scalemxAr -scalemxAl.
Qed.

End Step.

Section Path.
Variables (R : realFieldType) (d : nat).
Implicit Types (M P : nat -> 'M[R]_d) (c : nat -> R).

Fixpoint transition M k : 'M[R]_d := if k is k'.+1 then M k' *m transition M k' else 1%:M.

Fixpoint decay c k : R := if k is k'.+1 then decay c k' * (1 - (c k')^-1) else 1.

(** WG-L2.2: the factors multiply along a path: M(k−1)⋯M(0) P(0) (M(k−1)⋯M(0))ᵀ ⪯ ∏ (1 − 1/c(i)) P(k). *)
Theorem closed_loop_product M P c k :
  (forall i, 1 <= c i) -> (forall i, M i *m P i *m (M i)^T ⪯ (1 - (c i)^-1) *: P i.+1) ->
  transition M k *m P 0%N *m (transition M k)^T ⪯ decay c k *: P k.
Proof.
move=> c1 step; have f0 i : 0 <= 1 - (c i)^-1.
  by rewrite subr_ge0 invf_le1 //; apply: lt_le_trans (c1 i); apply: ltr01.
have g0 i : 0 <= decay c i by elim: i => [|i IH] /=; rewrite ?ler01 ?mulr_ge0.
elim: k => [|k IH] /=; first by rewrite mul1mx trmx1 mulmx1 scale1r; apply: loewner_refl.
have := congruence_mono (M k) IH; rewrite -scalemxAr -scalemxAl !mulmxA => h.
rewrite [(M k *m _)^T]trmx_mul !mulmxA; apply: loewner_trans h _.
by rewrite -scalerA; apply: loewnerZ.
Qed.

(** WG-55: ‖M(k−1) ⋯ M(0)‖² ≤ ∏ (1 − 1/c(i)) · ‖P(k)‖ ‖P(0)⁻¹‖, with p I ⪯ P(0) and P(k) ⪯ q I for the norms. *)
Theorem closed_loop_norm M P c k p q :
  (forall i, 1 <= c i) -> (forall i, M i *m P i *m (M i)^T ⪯ (1 - (c i)^-1) *: P i.+1) ->
  0 < p -> p *: 1%:M ⪯ P 0%N -> P k ⪯ q *: 1%:M ->
  transition M k *m (transition M k)^T ⪯ (decay c k * q / p) *: 1%:M.
Proof.
move=> c1 step p0 Pp Pq; have f0 i : 0 <= 1 - (c i)^-1.
  by rewrite subr_ge0 invf_le1 //; apply: lt_le_trans (c1 i); apply: ltr01.
have g0 i : 0 <= decay c i by elim: i => [|i IH] /=; rewrite ?ler01 ?mulr_ge0.
have h := loewner_trans (congruence_mono (transition M k) Pp) (closed_loop_product k c1 step).
have {h}h := loewner_trans h (loewnerZ (g0 k) Pq).
have pi : 0 <= p^-1 by rewrite invr_ge0 ltW.
have := loewnerZ pi h; rewrite -scalemxAr mulmx1 -scalemxAl !scalerA mulVf ?gt_eqF // scale1r.
by rewrite [_ * q / p]mulrC mulrA.
Qed.

End Path.

Section Observers.
Variables (R : realFieldType) (d m : nat).
Variables (F : nat -> 'M[R]_d) (H : nat -> 'M[R]_(m, d)) (N : nat -> 'M[R]_(d + m)).
Hypothesis psdN : forall k, psd (N k).

Fixpoint filter_path P0 k := if k is k'.+1 then riccati (F k') (H k') (N k') (filter_path P0 k') else P0.

Fixpoint observer_path (K : nat -> 'M[R]_(d, m)) P0 k :=
  if k is k'.+1 then joseph (F k') (H k') (N k') (observer_path K P0 k') (K k') else P0.

(** No observer that follows the recursion of the filter with other gains has a smaller error covariance. *)
Theorem filter_beats_observers K P0 k : psd P0 -> filter_path P0 k ⪯ observer_path K P0 k.
Proof.
move=> pP; have pk i : psd (filter_path P0 i) by elim: i => //= i; apply: riccati_psd.
elim: k => [|k IH] /=; first exact: loewner_refl.
apply: loewner_trans (riccati_upper _ _ (psdN k) (K k) (pk k)) _.
exact/residual_mono/stack_mono.
Qed.

End Observers.
