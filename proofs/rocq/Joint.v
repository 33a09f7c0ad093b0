(** * A joint covariance, its Schur complement and its gains

    J is the covariance of a pair (x, y), of sizes n and p.

      Jxx, Jxy, Jyx, Jyy   its blocks
      gain J               Jxy Jyy⁺, the gain of the best linear estimate of x from y
      schur J              Jxx − Jxy Jyy⁺ Jyx, the covariance of x − gain J · y
      residual J K         [I −K] J [I −K]ᵀ, the covariance of x − K y for any K (the form of Joseph)

    Jyy may be singular everywhere. Source: CKS, Lemma 3; EK-L1 to EK-L4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Kalman Require Import PositiveSemidefinite PseudoInverse.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Joint.
Variables (R : realFieldType) (n p : nat).
Implicit Types (J : 'M[R]_(n + p)) (K : 'M[R]_(n, p)).

Definition Jxx J : 'M_n := ulsubmx J.
Definition Jxy J : 'M_(n, p) := ursubmx J.
Definition Jyx J : 'M_(p, n) := dlsubmx J.
Definition Jyy J : 'M_p := drsubmx J.

Definition gain J : 'M_(n, p) := Jxy J *m (Jyy J)^†.
Definition schur J : 'M_n := Jxx J - Jxy J *m (Jyy J)^† *m Jyx J.
Definition residual J K : 'M_n := row_mx 1%:M (- K) *m J *m (row_mx 1%:M (- K))^T.

Lemma joint_blocks J : J = block_mx (Jxx J) (Jxy J) (Jyx J) (Jyy J).
Proof. by rewrite submxK. Qed.

Lemma JxxD J J' : Jxx (J + J') = Jxx J + Jxx J'. Proof. by apply/matrixP=> i j; rewrite !mxE. Qed.
Lemma JxyD J J' : Jxy (J + J') = Jxy J + Jxy J'. Proof. by apply/matrixP=> i j; rewrite !mxE. Qed.
Lemma JyyD J J' : Jyy (J + J') = Jyy J + Jyy J'. Proof. by apply/matrixP=> i j; rewrite !mxE. Qed.

Lemma JyxE J : psd J -> Jyx J = (Jxy J)^T.
Proof. by move=> pJ; rewrite psd_tr_ur. Qed.

Lemma psd_Jxx J : psd J -> psd (Jxx J). Proof. exact: psd_ul. Qed.
Lemma psd_Jyy J : psd J -> psd (Jyy J). Proof. exact: psd_dr. Qed.

(** EK-L1: the form of Joseph, multiplied out, for every matrix J and every gain K. *)
Theorem residual_expand J K :
  residual J K = Jxx J - K *m Jyx J - Jxy J *m K^T + K *m Jyy J *m K^T.
Proof.
rewrite /residual {1}(joint_blocks J) tr_row_mx trmx1 linearN /= mul_row_block mul_row_col.
by rewrite !mul1mx !mulmx1 !mulNmx !mulmxN mulmxBl opprB addrA [in RHS]addrAC.
Qed.

Lemma psd_residual J K : psd J -> psd (residual J K).
Proof. exact: psd_congruence. Qed.

Lemma residual_mono J J' K : J ⪯ J' -> residual J K ⪯ residual J' K.
Proof. exact: congruence_mono. Qed.

Lemma residualD J J' K : residual (J + J') K = residual J K + residual J' K.
Proof. by rewrite /residual mulmxDr mulmxDl. Qed.

Lemma residualZ a J K : residual (a *: J) K = a *: residual J K.
Proof. by rewrite /residual -scalemxAr -scalemxAl. Qed.

(** What y does not tell of itself it does not tell of x. *)
Lemma kernel_Jyy m J (M : 'M_(m, p)) : psd J -> M *m Jyy J = 0 -> M *m Jyx J = 0.
Proof.
move=> pJ MJ; apply/row_matrixP=> i; rewrite row0 row_mul; set y := row i M.
have yJ : y *m Jyy J = 0 by rewrite -row_mul MJ row0.
have : row_mx 0 y *m J = 0.
  apply: psd_kernel => //; rewrite /form {1}(joint_blocks J) mul_row_block !mul0mx !add0r yJ.
  by rewrite tr_row_mx mul_row_col trmx0 mulmx0 mul0mx addr0 mxE.
rewrite {1}(joint_blocks J) mul_row_block !mul0mx !add0r => e.
by have := congr1 lsubmx e; rewrite row_mxKl linear0.
Qed.

(** CKS-L3ii, EK-L2: Pxy Pyy⁺ Pyy = Pxy, which is Pxy (I − Pyy⁺Pyy) = 0, for every semidefinite joint covariance. *)
Theorem joint_range J : psd J -> Jxy J *m (Jyy J)^† *m Jyy J = Jxy J.
Proof.
move=> pJ; have sY := psd_sym (psd_Jyy pJ); apply: trmx_inj.
rewrite tr_mul3 -(JyxE pJ) sY pseudo_inverse_sym //; apply/esym/eqP.
rewrite -subr_eq0 -{1}(mul1mx (Jyx J)) -mulmxBl; apply/eqP/kernel_Jyy => //.
by rewrite mulmxBl mul1mx mulmx_pseudo_inverse subrr.
Qed.

(** CKS-L3ii, CKS-L3i: the residual x − gain J · y has the covariance schur J and is uncorrelated with y. *)
Theorem gain_decorrelates J : psd J -> row_mx 1%:M (- gain J) *m J = row_mx (schur J) 0.
Proof.
move=> pJ; rewrite {2}(joint_blocks J) mul_row_block !mul1mx !mulNmx /gain.
by rewrite joint_range // subrr.
Qed.

(** The gain of J on the left, any gain on the right: the covariance of both residuals is schur J. *)
Theorem residual_cross J K : psd J -> row_mx 1%:M (- gain J) *m J *m (row_mx 1%:M (- K))^T = schur J.
Proof. by move=> pJ; rewrite gain_decorrelates // tr_row_mx mul_row_col trmx1 mulmx1 mul0mx addr0. Qed.

(** CKS-L3i, HV-L3-cov: the gain Pxy Pyy⁺ leaves the covariance Pxx − Pxy Pyy⁺ Pyx. *)
Theorem residual_gain J : psd J -> residual J (gain J) = schur J.
Proof. exact: residual_cross. Qed.

(** CKS-L3i: completion of squares, for every gain K and a singular Pyy too. *)
Theorem completion_of_squares J K :
  psd J -> residual J K = schur J + (K - gain J) *m Jyy J *m (K - gain J)^T.
Proof.
move=> pJ; have sJ := psd_sym pJ; pose L := row_mx 1%:M (- gain J).
pose D : 'M_(n, n + p) := row_mx 0 (gain J - K).
have eK : row_mx 1%:M (- K) = L + D by rewrite add_row_mx addr0 addKr.
have LD : L *m J *m D^T = 0.
  by rewrite gain_decorrelates // tr_row_mx mul_row_col trmx0 mulmx0 mul0mx addr0.
have DL : D *m J *m L^T = 0 by rewrite -[D *m J *m _]trmxK tr_mul3 trmxK sJ LD trmx0.
have DD : D *m J *m D^T = (K - gain J) *m Jyy J *m (K - gain J)^T.
  rewrite {1}(joint_blocks J) mul_row_block !mul0mx !add0r tr_row_mx mul_row_col trmx0 mulmx0 add0r.
  by rewrite -opprB linearN /= mulmxN !mulNmx opprK.
rewrite /residual eK linearD /= mulmxDl mulmxDr mulmxDl mulmxDl.
by rewrite LD DL DD addr0 add0r -/(residual J (gain J)) residual_gain.
Qed.

(** EK-L3: what a gain K loses against the best one is (KΣ − Γ)Σ⁺(KΣ − Γ)ᵀ. *)
Theorem gain_defect J K : psd J ->
  residual J K - schur J = (K *m Jyy J - Jxy J) *m (Jyy J)^† *m (K *m Jyy J - Jxy J)^T.
Proof.
move=> pJ; rewrite completion_of_squares // addrC addKr.
have -> : K *m Jyy J - Jxy J = (K - gain J) *m Jyy J by rewrite mulmxBl /gain joint_range.
rewrite [(_ *m Jyy J)^T]trmx_mul psd_sym; last exact: psd_Jyy.
by rewrite !mulmxA -!(mulmxA (K - gain J)) mulmx_pseudo_inverse.
Qed.

(** The conditional covariance is semidefinite. *)
Theorem schur_psd J : psd J -> psd (schur J).
Proof. by move=> pJ; rewrite -residual_gain //; apply: psd_residual. Qed.

(** EK-L3: no gain does better than Pxy Pyy⁺. *)
Theorem schur_optimal J K : psd J -> schur J ⪯ residual J K.
Proof.
move=> pJ; rewrite completion_of_squares // addrC addKr.
exact/psd_congruence/psd_Jyy.
Qed.

(** EK-L3: a gain is as good as the best one if and only if KΣ = Γ. *)
Theorem optimal_gains J K : psd J -> (residual J K = schur J) <-> (K *m Jyy J = Jxy J).
Proof.
move=> pJ; have pY := psd_Jyy pJ; split=> [e|e]; last first.
  by apply/eqP; rewrite -subr_eq0 gain_defect // e subrr !mul0mx.
have z : (K - gain J) *m Jyy J *m (K - gain J)^T = 0.
  by apply: (addrI (schur J)); rewrite -completion_of_squares // addr0.
apply/eqP; rewrite -subr_eq0 -(joint_range pJ) -/(gain J) -mulmxBl; apply/eqP/row_matrixP=> i.
rewrite row0 row_mul; apply: psd_kernel => //.
by rewrite rowE -form_congr z form0.
Qed.

(** An observation never makes the covariance larger. *)
Theorem schur_le J : psd J -> schur J ⪯ Jxx J.
Proof.
move=> pJ; have := schur_optimal 0 pJ; rewrite residual_expand.
by rewrite !mul0mx trmx0 mulmx0 !subr0 addr0.
Qed.

(** The conditional covariance is monotone in the joint one. *)
Theorem schur_mono J J' : psd J -> J ⪯ J' -> schur J ⪯ schur J'.
Proof.
move=> pJ JJ'; have pJ' := psd_le pJ JJ'; rewrite -(residual_gain pJ').
exact: loewner_trans (schur_optimal _ pJ) (residual_mono _ JJ').
Qed.

(** It is superadditive, hence concave. *)
Theorem schur_superadditive J J' : psd J -> psd J' -> schur J + schur J' ⪯ schur (J + J').
Proof.
move=> pJ pJ'; rewrite -(residual_gain (psdD pJ pJ')) residualD.
exact: loewnerD (schur_optimal _ pJ) (schur_optimal _ pJ').
Qed.

Lemma schurZ a J : 0 <= a -> psd J -> schur (a *: J) = a *: schur J.
Proof.
move=> a0 pJ; rewrite -(residual_gain pJ) -residualZ; apply/esym/optimal_gains; first exact: psdZ.
have -> : Jyy (a *: J) = a *: Jyy J by apply/matrixP=> i j; rewrite !mxE.
have -> : Jxy (a *: J) = a *: Jxy J by apply/matrixP=> i j; rewrite !mxE.
by rewrite -scalemxAr /gain joint_range.
Qed.

Theorem schur_concave a J J' : 0 <= a -> a <= 1 -> psd J -> psd J' ->
  a *: schur J + (1 - a) *: schur J' ⪯ schur (a *: J + (1 - a) *: J').
Proof.
move=> a0 a1 pJ pJ'; have b0 : 0 <= 1 - a by rewrite subr_ge0.
by rewrite -!schurZ //; apply: schur_superadditive; apply: psdZ.
Qed.

Lemma row_free_1 m (B : 'M[R]_(n, m)) : row_free (row_mx 1%:M B).
Proof.
apply/inj_row_free => x; rewrite mul_mx_row mulmx1 => e.
by have := congr1 lsubmx e; rewrite row_mxKl linear0.
Qed.

(** Of a definite joint covariance it is definite. *)
Theorem schur_pd J : pd J -> pd (schur J).
Proof.
by move=> pJ; rewrite -(residual_gain (pd_psd pJ)); apply: pd_congruence => //; apply: row_free_1.
Qed.

End Joint.

(** In blocks. *)
Section Blocks.
Variables (R : realFieldType) (n p : nat) (A : 'M[R]_n) (B : 'M[R]_(n, p)) (C : 'M[R]_(p, n)) (D : 'M[R]_p).

Lemma schur_block : schur (block_mx A B C D) = A - B *m D^† *m C.
Proof. by rewrite /schur /Jxx /Jxy /Jyx /Jyy block_mxKul block_mxKur block_mxKdl block_mxKdr. Qed.

Lemma gain_block : gain (block_mx A B C D) = B *m D^†.
Proof. by rewrite /gain /Jxy /Jyy block_mxKur block_mxKdr. Qed.

Lemma residual_block K : residual (block_mx A B C D) K = A - K *m C - B *m K^T + K *m D *m K^T.
Proof. by rewrite residual_expand /Jxx /Jxy /Jyx /Jyy block_mxKul block_mxKur block_mxKdl block_mxKdr. Qed.

End Blocks.
