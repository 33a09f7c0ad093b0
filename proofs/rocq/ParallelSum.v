(** * The parallel sum of semidefinite matrices

      F ∥ G   F (F + G)⁺ G

    It is the Schur complement of [[F, F], [F, F + G]], the joint covariance of x and x + w with x of covariance F and
    an independent w of covariance G: what is left of F after reading x + w. Both may be singular.
    Source: AK, section 2 and Lemma 4.1; Anderson, Duffin 1969. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Definition parallel_sum (R : realFieldType) n (F G : 'M[R]_n) : 'M[R]_n := F *m (F + G)^† *m G.

Notation "F ∥ G" := (parallel_sum F G) (at level 45, left associativity).

Section ParallelSum.
Variables (R : realFieldType) (n : nat).
Implicit Types F G H : 'M[R]_n.

Definition noisy_copy F G : 'M[R]_(n + n) := block_mx F F F (F + G).

Lemma noisy_copyE F G :
  noisy_copy F G = col_mx 1%:M 1%:M *m F *m (col_mx 1%:M 1%:M)^T + block_mx 0 0 0 G.
Proof.
by rewrite mul_col_mx tr_col_mx mul_col_row !mul1mx !trmx1 !mulmx1 add_block_mx !addr0.
Qed.

Lemma psd_noisy_copy F G : psd F -> psd G -> psd (noisy_copy F G).
Proof.
move=> pF pG; rewrite noisy_copyE; apply: psdD; first exact: psd_congruence.
by apply: psd_block_diag => //; apply: psd0.
Qed.

(** AK-L4.1iv: F:G = F − F(F + G)⁺F, for singular F and G too. *)
Theorem parallel_sum_subtractive F G : psd F -> psd G -> F ∥ G = F - F *m (F + G)^† *m F.
Proof.
move=> pF pG; have := joint_range (psd_noisy_copy pF pG).
rewrite /Jxy /Jyy block_mxKur block_mxKdr mulmxDr => e.
by apply/eqP; rewrite eq_sym subr_eq -{1}e addrC.
Qed.

Lemma parallel_sum_schur F G : psd F -> psd G -> F ∥ G = schur (noisy_copy F G).
Proof. by move=> pF pG; rewrite parallel_sum_subtractive // schur_block. Qed.

(** AK-L4.1ii: F:G ⪰ 0. *)
Theorem parallel_sum_psd F G : psd F -> psd G -> psd (F ∥ G).
Proof. by move=> pF pG; rewrite parallel_sum_schur //; apply/schur_psd/psd_noisy_copy. Qed.

(** AK-L4.1ii: F:G = G:F. *)
Theorem parallel_sumC F G : psd F -> psd G -> F ∥ G = G ∥ F.
Proof.
move=> pF pG; rewrite -[LHS]psd_sym; last exact: parallel_sum_psd.
have [sF sG] := (psd_sym pF, psd_sym pG); rewrite /parallel_sum tr_mul3 sF sG.
by rewrite pseudo_inverse_sym ?(addrC G) // linearD /= sF sG.
Qed.

(** AK-L4.1iv: F:G ⪯ F. *)
Theorem parallel_sum_le F G : psd F -> psd G -> F ∥ G ⪯ F.
Proof.
move=> pF pG; rewrite parallel_sum_schur //.
by have := schur_le (psd_noisy_copy pF pG); rewrite /Jxx block_mxKul.
Qed.

(** AK-Par: F:G ⪯ G. *)
Theorem parallel_sum_le_right F G : psd F -> psd G -> F ∥ G ⪯ G.
Proof. by move=> pF pG; rewrite parallel_sumC //; apply: parallel_sum_le. Qed.

(** AK-L4.1iii: F ⪯ H ⇒ F:G ⪯ H:G. *)
Theorem parallel_sum_mono F H G : psd F -> psd G -> F ⪯ H -> F ∥ G ⪯ H ∥ G.
Proof.
move=> pF pG FH; have pH := psd_le pF FH; rewrite !parallel_sum_schur //.
apply: schur_mono; first exact: psd_noisy_copy.
by rewrite !noisy_copyE opprD addrACA subrr addr0; apply: congruence_mono.
Qed.

(** AK-L4.1iii: monotone in both arguments. *)
Theorem parallel_sum_mono2 F H G K : psd F -> psd G -> F ⪯ H -> G ⪯ K -> F ∥ G ⪯ H ∥ K.
Proof.
move=> pF pG FH GK; have [pH pK] := (psd_le pF FH, psd_le pG GK).
apply: loewner_trans (parallel_sum_mono pF pG FH) _.
by rewrite (parallel_sumC pH pG) (parallel_sumC pH pK); apply: parallel_sum_mono.
Qed.

Lemma noisy_copy_residual F G K :
  residual (noisy_copy F G) K = (1%:M - K) *m F *m (1%:M - K)^T + K *m G *m K^T.
Proof.
rewrite /residual noisy_copyE [in LHS]mulmxDr [in LHS]mulmxDl; congr (_ + _).
  by rewrite !mulmxA mul_row_col mul1mx mulmx1 -mulmxA -trmx_mul mul_row_col mul1mx mulmx1.
rewrite mul_row_block !mulmx0 !add0r tr_row_mx mul_row_col.
by rewrite linearN /= !(mulmx0, mul0mx, mulmxN, mulNmx) add0r opprK.
Qed.

(** For every K, (I − K)F(I − K)ᵀ + KGKᵀ is at least F:G. *)
Theorem parallel_sum_variational F G K : psd F -> psd G ->
  F ∥ G ⪯ (1%:M - K) *m F *m (1%:M - K)^T + K *m G *m K^T.
Proof.
move=> pF pG; rewrite parallel_sum_schur // -noisy_copy_residual.
exact/schur_optimal/psd_noisy_copy.
Qed.

(** AK-Par: no y has less than x(F:G)xᵀ for yFyᵀ + (x − y)G(x − y)ᵀ. *)
Theorem parallel_sum_least F G x y : psd F -> psd G ->
  form (F ∥ G) x x <= form F y y + form G (x - y) (x - y).
Proof.
move=> pF pG; have [-> | nx] := eqVneq x 0.
  by rewrite form0l addr_ge0 ?pF.2 ?pG.2.
pose K := (form 1%:M x x)^-1 *: (x^T *m (x - y)).
have xK : x *m K = x - y.
  have n0 : form 1%:M x x != 0 by apply: contraNneq nx => /form1_eq0 ->.
  rewrite -scalemxAr mulmxA [x *m x^T]mx11_scalar mul_scalar_mx scalerA.
  by have -> : (x *m x^T) 0 0 = form 1%:M x x; rewrite ?mulVf ?scale1r // /form mulmx1.
have := (parallel_sum_variational K pF pG).2 x.
rewrite formB subr_ge0 formD !form_congr mulmxBr mulmx1 xK.
by rewrite opprB addrCA subrr addr0.
Qed.

(** AK-Par: some y has x(F:G)xᵀ for yFyᵀ + (x − y)G(x − y)ᵀ, which is therefore the least value. *)
Theorem parallel_sum_attained F G x : psd F -> psd G ->
  exists y, form (F ∥ G) x x = form F y y + form G (x - y) (x - y).
Proof.
move=> pF pG; pose K := F *m (F + G)^†; exists (x *m (1%:M - K)).
have e : x - x *m (1%:M - K) = x *m K by rewrite mulmxBr mulmx1 opprB addrCA subrr addr0.
rewrite e -!form_congr -formD -noisy_copy_residual parallel_sum_schur //.
by rewrite -residual_gain ?gain_block //; apply: psd_noisy_copy.
Qed.

(** AK-Par-inverse: (F:G)⁻¹ = F⁻¹ + G⁻¹ for definite F and G. *)
Theorem parallel_sum_inverse F G : pd F -> pd G -> F ∥ G = invmx (invmx F + invmx G).
Proof.
move=> pF pG; have [uF uG] := (pd_unit pF, pd_unit pG); have uS := pd_unit (pdD pF (pd_psd pG)).
have e : invmx F + invmx G = invmx G *m (F + G) *m invmx F.
  by rewrite mulmxDr mulmxDl mulmxK // mulVmx // mul1mx addrC.
have uI : invmx F + invmx G \in unitmx by rewrite e !unitmx_mul !unitmx_inv uF uG uS.
apply: (can_inj (mulKmx uI)); rewrite mulmxV //.
by rewrite {1}e /parallel_sum pseudo_inverse_unit // !mulmxA mulmxKV // mulmxK // mulVmx.
Qed.

End ParallelSum.
