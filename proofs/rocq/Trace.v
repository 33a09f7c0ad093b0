(** * Traces of semidefinite matrices

    A semidefinite matrix is L D Lᵀ with a diagonal D ≥ 0: no square roots, so any ordered field will do. Hence
    tr(AB) ≥ 0 for semidefinite A and B, and tr(AB) = 0 only for B = 0 if A is definite. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Decomposition.
Variable R : realFieldType.

Lemma joint_split n p (J : 'M[R]_(n + p)) : psd J ->
  J = col_mx 1%:M 0 *m schur J *m (col_mx 1%:M 0)^T + col_mx (gain J) 1%:M *m Jyy J *m (col_mx (gain J) 1%:M)^T.
Proof.
move=> pJ; have [sY pY] := (psd_sym (psd_Jyy pJ), psd_Jyy pJ).
have gY : gain J *m Jyy J = Jxy J by rewrite /gain joint_range.
have Yg : Jyy J *m (gain J)^T = Jyx J by rewrite -{1}sY -trmx_mul gY JyxE.
rewrite !mul_col_mx !tr_col_mx !mul_mx_row -!block_mxEv !trmx1 !trmx0 !mulmx0 !mulmx1 !mul0mx !mul1mx add_block_mx !add0r.
by rewrite -(mulmxA (gain J)) Yg gY /schur -/(gain J) subrK -joint_blocks.
Qed.

(** Every semidefinite matrix is L D Lᵀ with a diagonal D ≥ 0. *)
Theorem psd_decomposition n (A : 'M[R]_n) : psd A ->
  exists (L : 'M[R]_n) (d : 'rV[R]_n), (forall i, 0 <= d 0 i) /\ A = L *m diag_mx d *m L^T.
Proof.
elim: n A => [|n IH] A pA; first by exists 0, 0; split=> [[]//|]; apply/matrixP=> [[]].
move: A pA; rewrite -[n.+1]addn1 => A pA.
have [L [d [d0 e]]] := IH _ (schur_psd pA).
exists (block_mx L (gain A) 0 1%:M), (row_mx d (Jyy A)); split.
  move=> i; case: (split_ordP i) => j ->; rewrite ?row_mxEl ?row_mxEr //.
  by have := (psd_Jyy pA).2 (delta_mx 0 j); rewrite form_delta (ord1 j).
rewrite [LHS](joint_split pA) e; have -> : diag_mx (row_mx d (Jyy A)) = block_mx (diag_mx d) 0 0 (Jyy A).
  by rewrite diag_mx_row; congr block_mx; apply/matrixP=> i j; rewrite !ord1 mxE eqxx.
rewrite mulmx_block tr_block_mx !(mulmx0, mul0mx, addr0, add0r, mul1mx).
rewrite mulmx_block !trmx0 !trmx1 !(mulmx0, mul0mx, addr0, add0r, mulmx1).
rewrite !mul_col_mx !tr_col_mx !mul_mx_row -!block_mxEv !trmx1 !trmx0.
by rewrite !(mulmx0, mul0mx, mulmx1, mul1mx) add_block_mx !add0r.
Qed.

Lemma trace_diag n (B : 'M[R]_n) (d : 'rV[R]_n) : \tr (diag_mx d *m B) = \sum_i d 0 i * B i i.
Proof. by apply: eq_bigr => i _; rewrite mul_diag_mx mxE. Qed.

(** The trace of a product of semidefinite matrices is nonnegative. *)
Theorem trace_mul_ge0 n (A B : 'M[R]_n) : psd A -> psd B -> 0 <= \tr (A *m B).
Proof.
move=> pA /psd_decomposition [L [d [d0 ->]]].
rewrite mulmxA mxtrace_mulC !mulmxA mxtrace_mulC trace_diag.
apply: sumr_ge0 => i _; apply: mulr_ge0 => //.
have pB : psd (L^T *m A *m L) by apply: psd_congruenceT.
by have := pB.2 (delta_mx 0 i); rewrite form_delta.
Qed.

Theorem trace_ge0 n (A : 'M[R]_n) : psd A -> 0 <= \tr A.
Proof. by move=> pA; rewrite -[A]mul1mx; apply: trace_mul_ge0 => //; apply: psd1. Qed.

Lemma trace_eq0 n (A : 'M[R]_n) : psd A -> \tr A = 0 -> A = 0.
Proof.
move=> pA t0; have d i : A i i = 0.
  apply/eqP; have : \sum_i A i i == 0 by apply/eqP.
  rewrite psumr_eq0 => [/allP/(_ i)|j _]; first by rewrite mem_index_enum => /(_ isT).
  by rewrite -form_delta pA.2.
apply/row_matrixP=> i; rewrite row0 rowE; apply: psd_kernel => //.
by rewrite form_delta.
Qed.

(** The trace of a product of a definite matrix and a semidefinite one is 0 only if the latter is. *)
Theorem trace_mul_eq0 n (A B : 'M[R]_n) : pd A -> psd B -> \tr (A *m B) = 0 -> B = 0.
Proof.
move=> pA /psd_decomposition [L [d [d0 ->]]].
rewrite mulmxA mxtrace_mulC !mulmxA mxtrace_mulC trace_diag => /eqP.
have e i : (L^T *m A *m L) i i = form A (row i L^T) (row i L^T).
  by rewrite -{2}[L]trmxK -form_delta form_congr -rowE.
rewrite psumr_eq0 => [/allP h|i _]; last by rewrite mulr_ge0 // e (pd_psd pA).2.
suff z : diag_mx d *m L^T = 0 by rewrite -mulmxA z mulmx0.
apply/row_matrixP=> i; rewrite row0 row_mul row_diag_mx -scalemxAl -rowE.
have := h i; rewrite mem_index_enum => /(_ isT); rewrite e mulf_eq0 => /orP[/eqP->|/eqP li].
  by rewrite scale0r.
have [->|nl] := eqVneq (row i L^T) 0; first by rewrite scaler0.
by have := pA.2 _ nl; rewrite li ltxx.
Qed.

(** Every semidefinite A is below a multiple of a definite B: A ⪯ tr(B⁻¹A) B. *)
Theorem psd_le_trace n (A B : 'M[R]_n) : psd A -> pd B -> A ⪯ \tr (invmx B *m A) *: B.
Proof.
move=> pA pB; have uB := pd_unit pB; split.
  by rewrite linearB linearZ /= (psd_sym pA) (pd_sym pB).
move=> x; rewrite formB formZ subr_ge0; have [L [d [d0 eA]]] := psd_decomposition pA.
rewrite eA mulmxA mxtrace_mulC !mulmxA mxtrace_mulC trace_diag form_congr.
set z := x *m L; have -> : form (diag_mx d) z z = \sum_i d 0 i * z 0 i ^+ 2.
  rewrite /form mxE; apply: eq_bigr => i _; rewrite mul_mx_diag !mxE.
  by rewrite mulrAC mulrC expr2.
rewrite mulr_suml; apply: ler_sum => i _; rewrite -mulrA; apply: ler_wpmul2l => //.
pose y := row i L^T *m invmx B.
have ey : (L^T *m invmx B *m L) i i = form B y y.
  rewrite /y -form_delta -{2}[L]trmxK form_congr -rowE /form trmx_mul !mulmxA mulmxKV //.
  by rewrite trmx_inv (pd_sym pB).
have xy : form B x y = z 0 i.
  rewrite /form /y trmx_mul trmx_inv (pd_sym pB) !mulmxA mulmxK //.
  by rewrite tr_row trmxK colE mulmxA -colE mxE.
by rewrite ey -xy mulrC; apply/cauchy_schwarz/pd_psd.
Qed.

Lemma psd_le_pd n (A B : 'M[R]_n) : psd A -> pd B -> exists2 b, 1 <= b & A ⪯ b *: B.
Proof.
move=> pA pB; have pA' := psd_le_trace pA pB; set t := \tr _ in pA'.
have t0 : 0 <= t by apply: trace_mul_ge0 => //; apply/pd_psd/pd_inv.
exists (1 + t); first by rewrite ler_addl.
by apply: loewner_trans pA' _; rewrite -scalerBl addrK scale1r; apply: pd_psd.
Qed.

End Decomposition.
