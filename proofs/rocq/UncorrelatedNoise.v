(** * The Riccati map of Anderson et al.: every state is read, the noises are uncorrelated

      anderson A V W S    φ(S) = A (S:W) Aᵀ + V
      anderson_closed     D = A W (T + W)⁺, the closed loop

    It is the map of Riccati.v with C = I and N = diag(V, W). V and W may be singular where V ≻ 0 is not asked for.
    Source: AK, sections 1, 2 and 4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From mathcomp.real_closed Require Import complex.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint Riccati ParallelSum Trace Stein FixedPoint.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Definition anderson (R : realFieldType) n (A V W S : 'M[R]_n) : 'M[R]_n := A *m (S ∥ W) *m A^T + V.
Definition anderson_closed (R : realFieldType) n (A W T : 'M[R]_n) : 'M[R]_n := A *m W *m (T + W)^†.

Section Filter.
Variables (R : realFieldType) (n : nat).
Implicit Types A V W S P : 'M[R]_n.

(** AK-1.4c: with Δ = S(S + W)⁺, P = (I − Δ)S is S:W. *)
Theorem filtered_covariance S W : psd S -> psd W -> (1%:M - S *m (S + W)^†) *m S = S ∥ W.
Proof. by move=> pS pW; rewrite parallel_sum_subtractive // mulmxBl mul1mx. Qed.

(** A step keeps covariances semidefinite: S = APAᵀ + V ⪰ 0 and P = S:W ⪰ 0 from any P(0) ⪰ 0. *)
Theorem filter_psd A V W P : psd V -> psd W -> psd P ->
  psd (A *m P *m A^T + V) /\ psd ((A *m P *m A^T + V) ∥ W).
Proof.
move=> pV pW pP; have pS : psd (A *m P *m A^T + V) by apply: psdD => //; apply: psd_congruence.
by split=> //; apply: parallel_sum_psd.
Qed.

(** AK-W0: W = 0 ⇒ P = (I − Δ)S = 0 with Δ = SS⁺; and P = 0 gives S = V, Δ = VV⁺ at the next step. *)
Theorem no_observation_noise A V S :
  (1%:M - S *m (S + 0)^†) *m S = 0 /\
  (A *m 0 *m A^T + V = V /\ (A *m 0 *m A^T + V) *m (A *m 0 *m A^T + V + 0)^† = V *m V^†).
Proof.
by rewrite addr0 mulmxBl mul1mx mulmx_pseudo_inverse subrr mulmx0 mul0mx add0r addr0.
Qed.

(** AK-5-G-limit: the equality (I − Δ)A = W(S + W)⁻¹A, where S + W is invertible; limits are not treated. *)
Theorem filter_transition A S W : S + W \in unitmx ->
  (1%:M - S *m (S + W)^†) *m A = W *m (S + W)^† *m A.
Proof.
move=> u; congr (_ *m _); rewrite pseudo_inverse_unit // -{1}(mulmxV u) -mulmxBl.
by rewrite addrC addKr.
Qed.

End Filter.

Section Map.
Variables (R : realFieldType) (n : nat) (A V W : 'M[R]_n).
Hypotheses (psdV : psd V) (psdW : psd W).
Implicit Types S T U L : 'M[R]_n.

Let phi := anderson A V W.
Definition uncorrelated : 'M[R]_(n + n) := block_mx V 0 0 W.

Lemma psd_uncorrelated : psd uncorrelated.
Proof. exact: psd_block_diag. Qed.

Lemma schur_uncorrelated : schur uncorrelated = V.
Proof. by rewrite schur_block !mul0mx subr0. Qed.

Lemma anderson_stack S :
  stack A 1%:M uncorrelated S = block_mx (A *m S *m A^T + V) (A *m S) (S *m A^T) (S + W).
Proof. by rewrite stack_blocks trmx1 !mulmx1 !mul1mx add_block_mx !addr0. Qed.

(** AK-4.1: φ(S) = A[S − S(S + W)⁺S]Aᵀ + V, for singular V and W too. *)
Theorem anderson_subtractive S : psd S ->
  phi S = A *m (S - S *m (S + W)^† *m S) *m A^T + V.
Proof. by move=> pS; rewrite /phi /anderson parallel_sum_subtractive. Qed.

(** AK-2.5: it is the Riccati map with C = I and uncorrelated noises. *)
Theorem andersonE S : psd S -> phi S = riccati A 1%:M uncorrelated S.
Proof.
move=> pS; rewrite anderson_subtractive // /riccati anderson_stack schur_block.
by rewrite mulmxBr mulmxBl !mulmxA addrAC.
Qed.

(** AK-1.4b: the gain of the Riccati map is AΔ with Δ = S(S + W)⁺. *)
Theorem anderson_gain S : riccati_gain A 1%:M uncorrelated S = A *m (S *m (S + W)^†).
Proof. by rewrite /riccati_gain /gain anderson_stack /Jxy /Jyy block_mxKur block_mxKdr mulmxA. Qed.

Lemma anderson_psd S : psd S -> psd (phi S).
Proof. by move=> pS; rewrite andersonE //; apply: riccati_psd => //; apply: psd_uncorrelated. Qed.

Lemma anderson_mono S T : psd S -> S ⪯ T -> phi S ⪯ phi T.
Proof.
move=> pS ST; have pT := psd_le pS ST; rewrite !andersonE //.
by apply: riccati_mono => //; apply: psd_uncorrelated.
Qed.

(** AK-4.2: V ⪯ φ(S), whatever S ⪰ 0. *)
Theorem anderson_lower S : psd S -> V ⪯ phi S.
Proof. by move=> pS; rewrite /phi /anderson addrK; apply/psd_congruence/parallel_sum_psd. Qed.

(** AK-4.2: φ(S) = A{W − W(S + W)⁺W}Aᵀ + V. *)
Theorem anderson_other_form S : psd S -> phi S = A *m (W - W *m (S + W)^† *m W) *m A^T + V.
Proof.
by move=> pS; rewrite /phi /anderson parallel_sumC // parallel_sum_subtractive // (addrC W S).
Qed.

(** AK-4.2: φ(S) ⪯ AWAᵀ + V. *)
Theorem anderson_upper S : psd S -> phi S ⪯ A *m W *m A^T + V.
Proof.
move=> pS; rewrite /phi /anderson opprD addrACA subrr addr0.
exact/congruence_mono/parallel_sum_le_right.
Qed.

(** AK-4.3: fixed points stay below AWAᵀ + V. *)
Theorem fixed_points_bounded T : psd T -> T = phi T -> T ⪯ A *m W *m A^T + V.
Proof. by move=> pT {1}->; apply: anderson_upper. Qed.

Let top := A *m W *m A^T + V.

Lemma psd_top : psd top.
Proof. by apply: psdD => //; apply: psd_congruence. Qed.

Lemma iter_anderson_psd S k : psd S -> psd (iter k phi S).
Proof. by move=> pS; elim: k => //= k; apply: anderson_psd. Qed.

Lemma iter_anderson_mono S T k : psd S -> S ⪯ T -> iter k phi S ⪯ iter k phi T.
Proof. by move=> pS ST; elim: k => //= k; apply: anderson_mono; apply: iter_anderson_psd. Qed.

(** AK-4.2-up: φᵏ(V) ⪯ φᵏ⁺¹(V) ⪯ AWAᵀ + V. *)
Theorem anderson_up k : iter k phi V ⪯ iter k.+1 phi V /\ iter k.+1 phi V ⪯ top.
Proof.
split; last by apply: anderson_upper; apply: iter_anderson_psd.
by rewrite iterSr; apply: iter_anderson_mono => //; apply: anderson_lower.
Qed.

(** AK-4.2-down: φᵏ⁺¹(AWAᵀ + V) ⪯ φᵏ(AWAᵀ + V). *)
Theorem anderson_down k : iter k.+1 phi top ⪯ iter k phi top.
Proof.
have pT := psd_top; rewrite iterSr; apply: iter_anderson_mono; first exact: anderson_psd.
exact: anderson_upper.
Qed.

(** AK-4.2-sandwich: φᵏ(V) ⪯ φᵏ⁺¹(S) ⪯ φᵏ(AWAᵀ + V) for every S ⪰ 0. *)
Theorem anderson_sandwich S k : psd S ->
  iter k phi V ⪯ iter k.+1 phi S /\ iter k.+1 phi S ⪯ iter k phi top.
Proof.
move=> pS; rewrite iterSr; split; apply: iter_anderson_mono => //.
- exact: anderson_lower.
- exact: anderson_psd.
- exact: anderson_upper.
Qed.

(** From the second step on every iterate is between V and AWAᵀ + V. *)
Theorem anderson_interval S k : psd S -> V ⪯ iter k.+1 phi S /\ iter k.+1 phi S ⪯ top.
Proof.
by move=> pS; split; [apply: anderson_lower | apply: anderson_upper]; apply: iter_anderson_psd.
Qed.

(** AK-D: the closed loop of the Riccati map is AW(T + W)⁻¹. *)
Theorem anderson_closedE T : T + W \in unitmx ->
  closed A 1%:M (riccati_gain A 1%:M uncorrelated T) = anderson_closed A W T.
Proof.
move=> u; rewrite /closed /riccati_gain anderson_stack gain_block mulmx1 /anderson_closed.
rewrite pseudo_inverse_unit // -{1}(mulmxK u A) -mulmxBl; congr (_ *m _).
by rewrite mulmxDr addrC addKr.
Qed.

(** AK-T2.3-diff: φ(T1) − φ(T2) = A{(T1:W) − (T2:W)}Aᵀ = D1(T1 − T2)D2ᵀ. *)
Theorem anderson_difference T1 T2 : psd T1 -> psd T2 -> T1 + W \in unitmx -> T2 + W \in unitmx ->
  phi T1 - phi T2 = A *m (T1 ∥ W - T2 ∥ W) *m A^T /\
  phi T1 - phi T2 = anderson_closed A W T1 *m (T1 - T2) *m (anderson_closed A W T2)^T.
Proof.
move=> p1 p2 u1 u2; split; first by rewrite /phi /anderson opprD addrACA subrr addr0 mulmxBr mulmxBl.
by rewrite !andersonE // riccati_difference ?anderson_closedE //; apply: psd_uncorrelated.
Qed.

(** AK-T2.3-diff: for two fixed points the difference is D1ᵏ(T1 − T2)(D2ᵀ)ᵏ for every k. *)
Theorem fixed_points_difference T1 T2 k : psd T1 -> psd T2 -> T1 + W \in unitmx -> T2 + W \in unitmx ->
  T1 = phi T1 -> T2 = phi T2 ->
  T1 - T2 = iter k (fun X => anderson_closed A W T1 *m X *m (anderson_closed A W T2)^T) (T1 - T2).
Proof.
move=> p1 p2 u1 u2 e1 e2; elim: k => //= k <-.
by rewrite -(proj2 (anderson_difference p1 p2 u1 u2)) -e1 -e2.
Qed.

Hypothesis pdV : pd V.

Lemma fixed_point_pd T : psd T -> T = phi T -> pd T.
Proof. by move=> pT {1}->; apply: pd_le pdV _; apply: anderson_lower. Qed.

Lemma fixed_sum_unit T : psd T -> T = phi T -> T + W \in unitmx.
Proof. by move=> pT eT; apply/pd_unit/pdD => //; apply: fixed_point_pd. Qed.

(** AK-L4.3-id: T − DTDᵀ = AT(T + W)⁻¹W(T + W)⁻¹TAᵀ + V. *)
Theorem closed_loop_stein T : psd T -> T = phi T -> let D := anderson_closed A W T in
  T - D *m T *m D^T = A *m T *m (T + W)^† *m W *m (T + W)^† *m T *m A^T + V.
Proof.
move=> pT eT /=; have u := fixed_sum_unit pT eT; have sZ : (T + W)^†^T = (T + W)^†.
  by rewrite pseudo_inverse_sym // linearD /= (psd_sym pT) (psd_sym psdW).
have pN := psd_uncorrelated; rewrite {1}eT andersonE // riccati_lyapunov // anderson_closedE //.
rewrite addrC addKr residual_block !mulmx0 !mul0mx !subr0 addrC.
rewrite /riccati_gain anderson_stack gain_block (trmx_mul (A *m T)) sZ (trmx_mul A) (psd_sym pT).
by rewrite !mulmxA.
Qed.

(** AK-L4.3: V ≻ 0 and T = φ(T) make T a certificate that the closed loop is stable: T − DTDᵀ ≻ 0. *)
Theorem closed_loop_contraction T : psd T -> T = phi T -> contraction (anderson_closed A W T).
Proof.
move=> pT eT; rewrite -anderson_closedE; last exact: fixed_sum_unit.
apply: fixed_contraction => //; rewrite ?schur_uncorrelated // -?andersonE //.
exact: psd_uncorrelated.
Qed.

(** AK-T2.3: V ≻ 0 and W ⪰ 0: at most one fixed point, for every A. *)
Theorem anderson_unique T1 T2 : psd T1 -> psd T2 -> T1 = phi T1 -> T2 = phi T2 -> T1 = T2.
Proof.
move=> p1 p2 e1 e2; have pN := psd_uncorrelated.
by apply: (fixed_point_unique pN (A := A) (C := 1%:M)); rewrite ?schur_uncorrelated -?andersonE.
Qed.

Lemma iter_andersonE S k : psd S -> iter k phi S = iter k (riccati A 1%:M uncorrelated) S.
Proof.
move=> pS; elim: k => //= k IH; rewrite -IH -andersonE //.
exact: iter_anderson_psd.
Qed.

(** AK-T2.3: if there is a fixed point T, every orbit closes in on it: from any S ⪯ bT, (1 − (1 − e)ᵏ)T ⪯ φᵏ(S) ⪯ (1 + (b − 1)(1 − e)ᵏ)T, where eT ⪯ V. *)
Theorem anderson_convergence T e b S k : psd T -> T = phi T -> 0 < e -> e <= 1 -> e *: T ⪯ V ->
  psd S -> 1 <= b -> S ⪯ b *: T ->
  (1 - (1 - e) ^+ k) *: T ⪯ iter k phi S /\ iter k phi S ⪯ (1 + (b - 1) * (1 - e) ^+ k) *: T.
Proof.
move=> pT eT e0 e1 eV pS b1 Sb; rewrite iter_andersonE //.
by apply: convergence => //; rewrite ?schur_uncorrelated -?andersonE //; apply: psd_uncorrelated.
Qed.

(** AK-T2.3, AK-5-r: with AWAᵀ + V ⪯ bT the same bounds about a fixed point T serve all S ⪰ 0; over an archimedean field that is one number of steps. *)
Theorem anderson_uniform T e b S k : psd T -> T = phi T -> 0 < e -> e <= 1 -> e *: T ⪯ V ->
  psd S -> 1 <= b -> top ⪯ b *: T ->
  (1 - (1 - e) ^+ k) *: T ⪯ iter k.+1 phi S /\ iter k.+1 phi S ⪯ (1 + (b - 1) * (1 - e) ^+ k) *: T.
Proof.
move=> pT eT e0 e1 eV pS b1 Tb; rewrite iterSr; apply: anderson_convergence => //.
  exact: anderson_psd.
by apply: loewner_trans Tb; apply: anderson_upper.
Qed.

End Map.

Section Certificates.
Variables (R : archiFieldType) (n : nat) (A V W T : 'M[R]_n).
Hypotheses (pdV : pd V) (psdW : psd W) (pT : psd T) (eT : T = anderson A V W T).

Let pV := pd_psd pdV.

(** AK-4.2-sandwich: every φ(U) ⪯ U and L ⪯ φ(L) enclose the fixed point. *)
Theorem anderson_certificates L U : psd L -> psd U -> L ⪯ anderson A V W L -> anderson A V W U ⪯ U ->
  L ⪯ T /\ T ⪯ U.
Proof.
move=> pL pU; rewrite !andersonE // => LL UU; have pN := psd_uncorrelated pV psdW.
have eT' : T = riccati A 1%:M (uncorrelated V W) T by rewrite -andersonE.
have pS : pd (schur (uncorrelated V W)) by rewrite schur_uncorrelated.
by split; [apply: certificate_below pN pS _ pT eT' _ pL LL | apply: certificate_above pN pS _ pT eT' _ pU UU].
Qed.

End Certificates.

Section Stability.
Variables (R : rcfType) (n : nat) (A V W T : 'M[R]_n).
Hypotheses (pdV : pd V) (psdW : psd W) (pT : psd T) (eT : T = anderson A V W T).

(** AK-L4.3: ρ(D) < 1: every eigenvalue of D = AW(T + W)⁻¹ in R[i] is inside the unit circle. *)
Theorem closed_loop_stable (z : R[i]) :
  root (char_poly (map_mx (real_complex R) (anderson_closed A W T))) z -> `|z| < 1.
Proof. by apply: contraction_eigenvalues; apply: closed_loop_contraction eT => //; apply: pd_psd. Qed.

(** AK-5-rho: ρ(G) < 1 for the transition G = W(T + W)⁻¹A of the filter in the limit. *)
Theorem filter_transition_stable (z : R[i]) :
  root (char_poly (map_mx (real_complex R) (W *m (T + W)^† *m A))) z -> `|z| < 1.
Proof.
have [-> _|nz] := eqVneq z 0; first by rewrite normr0 ltr01.
rewrite -eigenvalue_root_char map_mxM => /(eigenvalue_mulC nz).
by rewrite -map_mxM mulmxA eigenvalue_root_char; apply: closed_loop_stable.
Qed.

End Stability.
