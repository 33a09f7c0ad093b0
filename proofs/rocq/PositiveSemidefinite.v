(** * Quadratic forms and the Loewner order

    A vector is a row, as everywhere in MathComp: the form of a matrix A is x A yᵀ.

      form A x y   x A yᵀ, a number
      psd A        A is symmetric and form A x x ≥ 0 for every x
      pd A         A is symmetric and form A x x > 0 for every x ≠ 0
      A ⪯ B        psd (B − A), the order of Loewner
      A ≺ B        pd (B − A)

    Numbers are those of any ordered field (realFieldType): rationals, algebraic reals, reals.
    Source: Horn, Johnson, Matrix Analysis, chapter 7; AK, page 2065, for the order. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Definitions.
Variable R : realFieldType.

Definition form m n (A : 'M[R]_(m, n)) (x : 'rV[R]_m) (y : 'rV[R]_n) : R := (x *m A *m y^T) 0 0.

Definition psd n (A : 'M[R]_n) := A^T = A /\ forall x, 0 <= form A x x.
Definition pd n (A : 'M[R]_n) := A^T = A /\ forall x, x != 0 -> 0 < form A x x.

End Definitions.

Notation "A ⪯ B" := (psd (B - A)) (at level 70, no associativity).
Notation "A ≺ B" := (pd (B - A)) (at level 70, no associativity).

(** Transposes of products, for any ring that commutes. *)
Section Transpose.
Variable R : comRingType.

Lemma tr_mul3 m n p q (A : 'M[R]_(m, n)) (B : 'M[R]_(n, p)) (C : 'M[R]_(p, q)) :
  (A *m B *m C)^T = C^T *m B^T *m A^T.
Proof. by rewrite [in LHS]trmx_mul (trmx_mul A B) mulmxA. Qed.

Lemma tr_congr m n (C : 'M[R]_(m, n)) (A : 'M[R]_n) : A^T = A -> (C *m A *m C^T)^T = C *m A *m C^T.
Proof. by move=> sA; rewrite tr_mul3 trmxK sA. Qed.

End Transpose.

Section Forms.
Variable R : realFieldType.

Lemma formDl m n (A : 'M[R]_(m, n)) x y z : form A (x + y) z = form A x z + form A y z.
Proof. by rewrite /form !mulmxDl mxE. Qed.

Lemma formDr m n (A : 'M[R]_(m, n)) x y z : form A x (y + z) = form A x y + form A x z.
Proof. by rewrite /form linearD mulmxDr mxE. Qed.

Lemma formZl m n (A : 'M[R]_(m, n)) a x y : form A (a *: x) y = a * form A x y.
Proof. by rewrite /form -!scalemxAl mxE. Qed.

Lemma formZr m n (A : 'M[R]_(m, n)) a x y : form A x (a *: y) = a * form A x y.
Proof. by rewrite /form linearZ -scalemxAr mxE. Qed.

Lemma formD m n (A B : 'M[R]_(m, n)) x y : form (A + B) x y = form A x y + form B x y.
Proof. by rewrite /form mulmxDr mulmxDl mxE. Qed.

Lemma formN m n (A : 'M[R]_(m, n)) x y : form (- A) x y = - form A x y.
Proof. by rewrite /form mulmxN mulNmx mxE. Qed.

Lemma formB m n (A B : 'M[R]_(m, n)) x y : form (A - B) x y = form A x y - form B x y.
Proof. by rewrite formD formN. Qed.

Lemma formZ m n a (A : 'M[R]_(m, n)) x y : form (a *: A) x y = a * form A x y.
Proof. by rewrite /form -scalemxAr -scalemxAl mxE. Qed.

Lemma form0 m n x y : form (0 : 'M[R]_(m, n)) x y = 0.
Proof. by rewrite /form mulmx0 mul0mx mxE. Qed.

Lemma form0l m n (A : 'M[R]_(m, n)) y : form A 0 y = 0.
Proof. by rewrite /form !mul0mx mxE. Qed.

Lemma form_tr m n (A : 'M[R]_(m, n)) x y : form A^T x y = form A y x.
Proof. by rewrite /form -[in RHS](trmxK (y *m A *m x^T)) tr_mul3 trmxK [RHS]mxE. Qed.

Lemma form_sym n (A : 'M[R]_n) x y : A^T = A -> form A x y = form A y x.
Proof. by move=> sA; rewrite -[in LHS]sA form_tr. Qed.

Lemma form_congr m n p q (C : 'M[R]_(m, n)) (A : 'M[R]_(n, p)) (D : 'M[R]_(q, p)) x y :
  form (C *m A *m D^T) x y = form A (x *m C) (y *m D).
Proof. by rewrite /form [in RHS]trmx_mul !mulmxA. Qed.

Lemma form_delta m n (A : 'M[R]_(m, n)) i j : form A (delta_mx 0 i) (delta_mx 0 j) = A i j.
Proof. by rewrite /form -rowE trmx_delta -colE !mxE. Qed.

Lemma form_eq0 m n (A : 'M[R]_(m, n)) : (forall x y, form A x y = 0) -> A = 0.
Proof. by move=> h; apply/matrixP=> i j; rewrite -form_delta h mxE. Qed.

(** Squares of lengths. *)
Lemma form1 n (x : 'rV[R]_n) : form 1%:M x x = \sum_i x 0 i ^+ 2.
Proof. by rewrite /form mulmx1 mxE; apply: eq_bigr => i _; rewrite mxE expr2. Qed.

Lemma form1_ge0 n (x : 'rV[R]_n) : 0 <= form 1%:M x x.
Proof. by rewrite form1; apply: sumr_ge0 => i _; apply: sqr_ge0. Qed.

Lemma form1_eq0 n (x : 'rV[R]_n) : form 1%:M x x = 0 -> x = 0.
Proof.
rewrite form1 => /eqP; rewrite psumr_eq0 => [/allP h|i _]; last exact: sqr_ge0.
apply/rowP=> i; rewrite mxE; apply/eqP; rewrite -sqrf_eq0.
by have := h i; rewrite mem_index_enum => /(_ isT).
Qed.

End Forms.

Section Cone.
Variables (R : realFieldType) (n : nat).
Implicit Types A B C : 'M[R]_n.

Lemma psd_sym A : psd A -> A^T = A. Proof. by case. Qed.

Lemma psd0 : psd (0 : 'M[R]_n).
Proof. by split=> [|x]; rewrite ?trmx0 ?form0. Qed.

Lemma psd1 : psd (1%:M : 'M[R]_n).
Proof. by split=> [|x]; rewrite ?trmx1 ?form1_ge0. Qed.

Lemma pd1 : pd (1%:M : 'M[R]_n).
Proof.
split=> [|x nx]; first by rewrite trmx1.
by rewrite lt_def form1_ge0 andbT; apply: contraNneq nx => /form1_eq0 ->.
Qed.

Lemma pd_psd A : pd A -> psd A.
Proof.
case=> sA pA; split=> // x; have [-> | nx] := eqVneq x 0; first by rewrite form0l.
exact/ltW/pA.
Qed.

Lemma psdD A B : psd A -> psd B -> psd (A + B).
Proof.
by move=> [sA pA] [sB pB]; split=> [|x]; rewrite ?linearD /= ?sA ?sB // formD addr_ge0.
Qed.

Lemma pdD A B : pd A -> psd B -> pd (A + B).
Proof.
move=> [sA pA] [sB pB]; split=> [|x nx]; first by rewrite linearD /= sA sB.
by rewrite formD ltr_paddr ?pA.
Qed.

Lemma psd_pdD A B : psd A -> pd B -> pd (A + B).
Proof. by move=> pA pB; rewrite addrC; apply: pdD. Qed.

Lemma psdZ a A : 0 <= a -> psd A -> psd (a *: A).
Proof. by move=> a0 [sA pA]; split=> [|x]; rewrite ?linearZ /= ?sA // formZ mulr_ge0. Qed.

Lemma pdZ a A : 0 < a -> pd A -> pd (a *: A).
Proof.
by move=> a0 [sA pA]; split=> [|x nx]; rewrite ?linearZ /= ?sA // formZ mulr_gt0 ?pA.
Qed.

(** The order of Loewner is reflexive. *)
Theorem loewner_refl A : A ⪯ A.
Proof. by rewrite subrr; apply: psd0. Qed.

(** The order of Loewner is transitive. *)
Theorem loewner_trans B A C : A ⪯ B -> B ⪯ C -> A ⪯ C.
Proof. by move=> ab bc; have := psdD bc ab; rewrite addrA subrK. Qed.

Lemma psd_opp_eq0 A : psd A -> psd (- A) -> A = 0.
Proof.
move=> [sA pA] [_ nA]; have z x : form A x x = 0.
  by apply/eqP; rewrite eq_le pA andbT -oppr_ge0 -formN nA.
apply: form_eq0 => x y; have := z (x + y).
rewrite formDl !formDr !z add0r addr0 (form_sym y x sA) -mulr2n => /eqP.
by rewrite mulrn_eq0 => /eqP.
Qed.

(** The order of Loewner is antisymmetric. *)
Theorem loewner_antisym A B : A ⪯ B -> B ⪯ A -> A = B.
Proof.
move=> ab ba; apply/eqP; rewrite -subr_eq0; apply/eqP/psd_opp_eq0 => //.
by rewrite opprB.
Qed.

Lemma loewnerD A B C D : A ⪯ B -> C ⪯ D -> A + C ⪯ B + D.
Proof. by move=> ab cd; rewrite opprD addrACA; apply: psdD. Qed.

Lemma loewner_addr A B : psd B -> A ⪯ A + B.
Proof. by rewrite addrC addrA addNr add0r. Qed.

Lemma loewner_subr A B : psd B -> A - B ⪯ A.
Proof. by rewrite opprB addrC subrK. Qed.

Lemma loewnerZ a A B : 0 <= a -> A ⪯ B -> a *: A ⪯ a *: B.
Proof. by move=> a0 ab; rewrite -scalerBr; apply: psdZ. Qed.

Lemma psd_le A B : psd A -> A ⪯ B -> psd B.
Proof. by move=> pA ab; rewrite -(subrK A B); apply: psdD. Qed.

Lemma pd_le A B : pd A -> A ⪯ B -> pd B.
Proof. by move=> pA ab; rewrite -(subrK A B) addrC; apply: pdD. Qed.

End Cone.

Section Congruence.
Variable R : realFieldType.

(** Covariance matrices stay covariance matrices under linear maps. *)
Theorem psd_congruence m n (C : 'M[R]_(m, n)) A : psd A -> psd (C *m A *m C^T).
Proof. by case=> sA pA; split=> [|x]; [apply: tr_congr | rewrite form_congr]. Qed.

Lemma psd_congruenceT m n (C : 'M[R]_(m, n)) A : psd A -> psd (C^T *m A *m C).
Proof. by move=> pA; have := psd_congruence C^T pA; rewrite trmxK. Qed.

Lemma congruence_mono m n (C : 'M[R]_(m, n)) A B : A ⪯ B -> C *m A *m C^T ⪯ C *m B *m C^T.
Proof. by move=> ab; rewrite -mulmxBl -mulmxBr; apply: psd_congruence. Qed.

Lemma psd_gram m n (C : 'M[R]_(m, n)) : psd (C *m C^T).
Proof. by have := psd_congruence C (psd1 R n); rewrite mulmx1. Qed.

(** Of full row rank: nothing but 0 is mapped to 0. *)
Lemma pd_congruence m n (C : 'M[R]_(m, n)) A : row_free C -> pd A -> pd (C *m A *m C^T).
Proof.
move=> fC [sA pA]; split=> [|x nx]; first exact: tr_congr.
rewrite form_congr pA //; apply: contraNneq nx => xC.
by apply/eqP/(row_free_inj fC); rewrite xC mul0mx.
Qed.

Lemma pd_gram m n (C : 'M[R]_(m, n)) : row_free C -> pd (C *m C^T).
Proof. by move=> fC; have := pd_congruence fC (pd1 R n); rewrite mulmx1. Qed.

Lemma gram_eq0 m n (C : 'M[R]_(m, n)) : C *m C^T = 0 -> C = 0.
Proof.
move=> h; apply/row_matrixP=> i; rewrite row0; apply: form1_eq0.
by rewrite rowE -form_congr mulmx1 h form0.
Qed.

End Congruence.

Section CauchySchwarz.
Variables (R : realFieldType) (n : nat).
Implicit Types (A : 'M[R]_n) (x y : 'rV[R]_n).

(** For a semidefinite form, (x A yᵀ)² ≤ x A xᵀ · y A yᵀ. *)
Theorem cauchy_schwarz A x y : psd A -> form A x y ^+ 2 <= form A x x * form A y y.
Proof.
move=> [sA pA]; have pos u v : 0 < form A v v -> form A u v ^+ 2 <= form A u u * form A v v.
  move=> v0; rewrite -subr_ge0 -(pmulr_rge0 _ v0).
  have := pA (form A v v *: u - form A u v *: v).
  rewrite -!scaleNr !(formDl, formDr, formZl, formZr) (form_sym v u sA).
  congr (0 <= _); set a := form A v v; set b := form A u v; set c := form A u u; ring.
have := pA y; rewrite le_eqVlt => /orP[/eqP y0|/pos//].
have := pA x; rewrite le_eqVlt => /orP[/eqP x0|/(pos y)]; last first.
  by rewrite (form_sym y x sA) mulrC.
rewrite -x0 mul0r; suff -> : form A x y = 0 by rewrite expr0n.
have := pA (x + y); have := pA (x - y).
rewrite -scaleN1r !(formDl, formDr, formZl, formZr) -x0 -y0 (form_sym y x sA).
rewrite !(mulr0, addr0, add0r) mulN1r -opprD oppr_ge0 -mulr2n pmulrn_lle0 // pmulrn_lge0 // => h1 h2.
by apply/eqP; rewrite eq_le h1 h2.
Qed.

(** A vector of length zero in the form is in its kernel. *)
Theorem psd_kernel A x : psd A -> form A x x = 0 -> x *m A = 0.
Proof.
move=> pA x0; apply/rowP=> j; rewrite [RHS]mxE.
have : form A x (delta_mx 0 j) ^+ 2 <= 0 by apply: le_trans (cauchy_schwarz _ _ pA) _; rewrite x0 mul0r.
by rewrite exprn_even_le0 //= /form trmx_delta -colE mxE => /eqP.
Qed.

Lemma pd_free A x : pd A -> x *m A = 0 -> x = 0.
Proof.
move=> [_ pA] xA; apply/eqP/negPn/negP => /pA.
by rewrite /form xA mul0mx mxE ltxx.
Qed.

(** Definite matrices are invertible. *)
Theorem pd_unit A : pd A -> A \in unitmx.
Proof.
move=> pA; rewrite -row_free_unit; apply/inj_row_free => x; exact: pd_free.
Qed.

(** Semidefinite matrices that are invertible are definite. *)
Theorem psd_unit_pd A : psd A -> A \in unitmx -> pd A.
Proof.
move=> pA uA; split=> [|x nx]; first exact: psd_sym.
rewrite lt_def pA.2 andbT; apply: contraNneq nx => /(psd_kernel pA) xA.
by rewrite -(mulmxK uA x) xA mul0mx.
Qed.

Lemma pd_sym A : pd A -> A^T = A. Proof. by case. Qed.

Lemma pd_inv A : pd A -> pd (invmx A).
Proof.
move=> pA; have uA := pd_unit pA.
have e : invmx A = invmx A *m A *m (invmx A)^T by rewrite mulVmx // mul1mx trmx_inv pd_sym.
rewrite e; apply: pd_congruence => //.
by rewrite row_free_unit unitmx_inv.
Qed.

(** Inverses turn the order round. *)
Theorem pd_inv_antitone A B : pd A -> A ⪯ B -> invmx B ⪯ invmx A.
Proof.
move=> pA AB; have pB := pd_le pA AB; have [pA' pB'] := (pd_inv pA, pd_inv pB).
split=> [|x]; first by rewrite linearB /= (pd_sym pA') (pd_sym pB').
rewrite formB subr_ge0; pose u := x *m invmx B; pose v := x *m invmx A.
have eB : form (invmx B) x x = form B u u.
  by rewrite /form /u trmx_mul (pd_sym pB') mulmxKV ?pd_unit // mulmxA.
have eA : form A v v = form (invmx A) x x.
  by rewrite /form /v trmx_mul (pd_sym pA') mulmxKV ?pd_unit // mulmxA.
have eq : form B u u = form A u v.
  rewrite -eB /form /v trmx_mul (pd_sym pA') !mulmxA mulmxK ?pd_unit //.
have := (pd_psd pB).2 u; rewrite eB le_eqVlt => /orP[/eqP<-|q0]; first exact: (pd_psd pA').2.
rewrite -(ler_pmul2l q0); have := cauchy_schwarz u v (pd_psd pA); rewrite -eq eA expr2 => /le_trans; apply.
by apply: ler_wpmul2r; [exact: (pd_psd pA').2 | rewrite -subr_ge0 -formB AB.2].
Qed.

End CauchySchwarz.

Section Blocks.
Variables (R : realFieldType) (n p : nat).

Lemma ulsubmx_congr (J : 'M[R]_(n + p)) : ulsubmx J = row_mx 1%:M 0 *m J *m (row_mx 1%:M 0)^T.
Proof.
rewrite -{2}(submxK J) tr_row_mx trmx1 trmx0 mul_row_block mul_row_col.
by rewrite !mul1mx !mul0mx !mulmx1 !mulmx0 !addr0.
Qed.

Lemma drsubmx_congr (J : 'M[R]_(n + p)) : drsubmx J = row_mx 0 1%:M *m J *m (row_mx 0 1%:M)^T.
Proof.
rewrite -{2}(submxK J) tr_row_mx trmx1 trmx0 mul_row_block mul_row_col.
by rewrite !mul1mx !mul0mx !mulmx1 !mulmx0 !add0r.
Qed.

Lemma psd_ul (J : 'M[R]_(n + p)) : psd J -> psd (ulsubmx J).
Proof. by rewrite ulsubmx_congr; apply: psd_congruence. Qed.

Lemma psd_dr (J : 'M[R]_(n + p)) : psd J -> psd (drsubmx J).
Proof. by rewrite drsubmx_congr; apply: psd_congruence. Qed.

Lemma psd_tr_ur (J : 'M[R]_(n + p)) : psd J -> (ursubmx J)^T = dlsubmx J.
Proof. by move=> /psd_sym sJ; rewrite -{2}sJ -trmx_ursub. Qed.

Lemma psd_block_diag (A : 'M[R]_n) (B : 'M[R]_p) : psd A -> psd B -> psd (block_mx A 0 0 B).
Proof.
move=> [sA pA] [sB pB]; split=> [|x]; first by rewrite tr_block_mx !trmx0 sA sB.
rewrite /form -(hsubmxK x) tr_row_mx mul_row_block mul_row_col !mulmx0 addr0 add0r mxE.
by rewrite addr_ge0 ?pA ?pB.
Qed.

Lemma pd_block_diag (A : 'M[R]_n) (B : 'M[R]_p) : pd A -> pd B -> pd (block_mx A 0 0 B).
Proof.
move=> pA pB; apply: psd_unit_pd; first exact: psd_block_diag (pd_psd pA) (pd_psd pB).
by rewrite unitmxE det_ublock unitrM -!unitmxE !pd_unit.
Qed.

End Blocks.
