(** * The pseudo-inverse of Moore and Penrose

      is_pseudo_inverse A X   the four equations of Penrose: AXA = A, XAX = X, (AX)ᵀ = AX, (XA)ᵀ = XA
      A ^†                    the pseudo-inverse of A, over an ordered field (of every matrix)
      full_rank_inverse U V   Vᵀ(VVᵀ)⁻¹(UᵀU)⁻¹Uᵀ, the pseudo-inverse of UV

    Over any field there is at most one; over an ordered field there is one, because UᵀU is then definite for every
    U of full column rank. Source: Penrose 1955; HV, Lemma 3; CKS, Lemma 3. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Kalman Require Import PositiveSemidefinite.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Penrose.
Variable F : fieldType.

Definition is_pseudo_inverse m n (A : 'M[F]_(m, n)) (X : 'M[F]_(n, m)) :=
  [/\ A *m X *m A = A, X *m A *m X = X, (A *m X)^T = A *m X & (X *m A)^T = X *m A].

(** CKS-L3-pinv: at most one matrix satisfies the four equations of Penrose. *)
Theorem pseudo_inverse_unique m n (A : 'M[F]_(m, n)) X Y :
  is_pseudo_inverse A X -> is_pseudo_inverse A Y -> X = Y.
Proof.
move=> [ax xa sax sxa] [ay ya say sya].
have eX : A *m X = A *m Y.
  by rewrite -say -[in RHS]ax -(mulmxA (A *m X)) [RHS]trmx_mul say sax mulmxA ay.
have eY : X *m A = Y *m A.
  by rewrite -sxa -[in LHS]ay -(mulmxA A Y) mulmxA [LHS]trmx_mul sya sxa -mulmxA (mulmxA A) ax.
by rewrite -xa eY -mulmxA eX mulmxA ya.
Qed.

Lemma pseudo_inverse_tr m n (A : 'M[F]_(m, n)) X : is_pseudo_inverse A X -> is_pseudo_inverse A^T X^T.
Proof.
by move=> [ax xa sax sxa]; split; rewrite -?tr_mul3 ?mulmxA -?trmx_mul ?sax ?sxa // ?trmx_mul // !mulmxA;
  rewrite -?tr_mul3 ?ax ?xa.
Qed.

Lemma pseudo_inverse_invmx n (A : 'M[F]_n) : A \in unitmx -> is_pseudo_inverse A (invmx A).
Proof. by move=> uA; split; rewrite ?mulmxV ?mulVmx ?mul1mx ?trmx1. Qed.

Lemma pseudo_inverse0 m n : is_pseudo_inverse (0 : 'M[F]_(m, n)) 0.
Proof. by split; rewrite ?mul0mx ?mulmx0 ?trmx0. Qed.

Definition full_rank_inverse m r n (U : 'M[F]_(m, r)) (V : 'M[F]_(r, n)) : 'M[F]_(n, m) :=
  V^T *m invmx (V *m V^T) *m invmx (U^T *m U) *m U^T.

(** HV-L3: for P = UV with UᵀU and VVᵀ invertible, the formula gives the pseudo-inverse, over any field. *)
Theorem full_rank_formula m r n (U : 'M[F]_(m, r)) (V : 'M[F]_(r, n)) :
  U^T *m U \in unitmx -> V *m V^T \in unitmx -> is_pseudo_inverse (U *m V) (full_rank_inverse U V).
Proof.
move=> uU uV; rewrite /full_rank_inverse; set G := U^T *m U; set H := V *m V^T.
have sG : (invmx G)^T = invmx G by rewrite trmx_inv trmx_mul trmxK.
have sH : (invmx H)^T = invmx H by rewrite trmx_inv trmx_mul trmxK.
have eL : U *m V *m (V^T *m invmx H *m invmx G *m U^T) = U *m invmx G *m U^T.
  by rewrite -(mulmxA U) !(mulmxA V) -/H mulmxV // mul1mx !mulmxA.
have eR : V^T *m invmx H *m invmx G *m U^T *m (U *m V) = V^T *m invmx H *m V.
  by rewrite mulmxA -(mulmxA _ U^T U) -/G mulmxKV.
split.
- by rewrite eL mulmxA -(mulmxA _ U^T U) -/G mulmxKV.
- by rewrite eR !mulmxA -(mulmxA _ V V^T) -/H mulmxKV.
- by rewrite eL tr_mul3 trmxK sG.
- by rewrite eR tr_mul3 trmxK sH.
Qed.

(** HV-L3: the formula gives the same for every factorisation. *)
Theorem full_rank_formula_unique m r s n
    (U : 'M[F]_(m, r)) (V : 'M[F]_(r, n)) (U' : 'M[F]_(m, s)) (V' : 'M[F]_(s, n)) :
  U^T *m U \in unitmx -> V *m V^T \in unitmx -> U'^T *m U' \in unitmx -> V' *m V'^T \in unitmx ->
  U *m V = U' *m V' -> full_rank_inverse U V = full_rank_inverse U' V'.
Proof.
move=> uU uV uU' uV' e; apply: (@pseudo_inverse_unique _ _ (U *m V)); first exact: full_rank_formula.
by rewrite e; apply: full_rank_formula.
Qed.

End Penrose.

Section OrderedField.
Variable R : realFieldType.

(** CKS-L3-pinv: over an ordered field every matrix has a pseudo-inverse. *)
Theorem pseudo_inverse_exists m n (A : 'M[R]_(m, n)) : {X | is_pseudo_inverse A X}.
Proof.
exists (full_rank_inverse (col_base A) (row_base A)); rewrite -{1}(mulmx_base A).
apply: full_rank_formula; apply: pd_unit.
  rewrite -[X in _ *m X]trmxK; apply: pd_gram.
  by rewrite /row_free mxrank_tr -/(row_full _) col_base_full.
exact/pd_gram/row_base_free.
Qed.

Definition pseudo_inverse m n (A : 'M[R]_(m, n)) : 'M[R]_(n, m) := sval (pseudo_inverse_exists A).

End OrderedField.

Notation "A ^†" := (pseudo_inverse A) (at level 8, format "A ^†").

Section Laws.
Variable R : realFieldType.

Lemma pseudo_inverseP m n (A : 'M[R]_(m, n)) : is_pseudo_inverse A A^†.
Proof. by rewrite /pseudo_inverse; case: pseudo_inverse_exists. Qed.

Lemma pseudo_inverse_eq m n (A : 'M[R]_(m, n)) X : is_pseudo_inverse A X -> A^† = X.
Proof. exact/pseudo_inverse_unique/pseudo_inverseP. Qed.

(** CKS-L3-pinv: the first equation, PP⁺P = P. *)
Theorem mulmx_pseudo_inverse m n (A : 'M[R]_(m, n)) : A *m A^† *m A = A.
Proof. by case: (pseudo_inverseP A). Qed.

Lemma pseudo_inverse_mulmx m n (A : 'M[R]_(m, n)) : A^† *m A *m A^† = A^†.
Proof. by case: (pseudo_inverseP A). Qed.

Lemma pseudo_inverse_trmx m n (A : 'M[R]_(m, n)) : A^T^† = A^†^T.
Proof. exact/pseudo_inverse_eq/pseudo_inverse_tr/pseudo_inverseP. Qed.

Lemma pseudo_inverse_sym n (A : 'M[R]_n) : A^T = A -> A^†^T = A^†.
Proof. by move=> sA; rewrite -pseudo_inverse_trmx sA. Qed.

(** CKS-L3-pinv: P⁺ = UPᵀ = PᵀV for some U and V. *)
Theorem pseudo_inverse_factors m n (A : 'M[R]_(m, n)) :
  (exists U, A^† = U *m A^T) /\ (exists V, A^† = A^T *m V).
Proof.
case: (pseudo_inverseP A) => ax xa sax sxa; split.
  by exists (A^† *m A^†^T); rewrite -mulmxA -trmx_mul sax mulmxA xa.
by exists (A^†^T *m A^†); rewrite mulmxA -trmx_mul sxa xa.
Qed.

(** CKS-L3-pinv: the two conditions AXA = A and X = UAᵀ = AᵀV determine the pseudo-inverse. *)
Theorem two_conditions_determine m n (A : 'M[R]_(m, n)) X U V :
  A *m X *m A = A -> X = U *m A^T -> X = A^T *m V -> X = A^†.
Proof.
have cancel p q r (B : 'M[R]_(p, q)) (M : 'M[R]_(r, q)) : M *m B^T *m B = 0 -> M *m B^T = 0.
  by move=> h; apply: gram_eq0; rewrite trmx_mul trmxK mulmxA h mul0mx.
move=> aX xu xv; have [[U' yu] [V' yv]] := pseudo_inverse_factors A.
apply/eqP; rewrite -subr_eq0; apply/eqP; set D := X - A^†.
have du : D = (U - U') *m A^T by rewrite mulmxBl -xu -yu.
have dv : D = A^T *m (V - V') by rewrite mulmxBr -xv -yv.
have ad : A *m D = 0.
  rewrite du mulmxA; apply: cancel; rewrite -(mulmxA A) -du.
  by rewrite mulmxBr mulmxBl aX mulmx_pseudo_inverse subrr.
have := cancel _ _ _ A^T (V - V')^T; rewrite trmxK => c.
by apply: trmx_inj; rewrite trmx0 dv trmx_mul trmxK c //; apply: trmx_inj; rewrite trmx0 tr_mul3 !trmxK -mulmxA -dv.
Qed.

(** Of an invertible matrix it is the inverse. *)
Theorem pseudo_inverse_unit n (A : 'M[R]_n) : A \in unitmx -> A^† = invmx A.
Proof. by move=> uA; apply/pseudo_inverse_eq/pseudo_inverse_invmx. Qed.

Lemma pseudo_inverse_zero m n : (0 : 'M[R]_(m, n))^† = 0.
Proof. exact/pseudo_inverse_eq/pseudo_inverse0. Qed.

(** HV-L3: over an ordered field P⁺ is the formula for every factorisation P = UV of full rank. *)
Theorem full_rank_pseudo_inverse m r n (U : 'M[R]_(m, r)) (V : 'M[R]_(r, n)) :
  row_full U -> row_free V -> (U *m V)^† = full_rank_inverse U V.
Proof.
move=> fU fV; apply/pseudo_inverse_eq/full_rank_formula; apply: pd_unit; last exact: pd_gram.
by rewrite -[X in _ *m X]trmxK; apply: pd_gram; rewrite /row_free mxrank_tr.
Qed.

(** HV-X.da: F⁺ = Fᵀ(FFᵀ)⁺ for every F. *)
Theorem pseudo_inverse_gram m n (F : 'M[R]_(m, n)) : F^† = F^T *m (F *m F^T)^†.
Proof.
have sG : (F *m F^T)^†^T = (F *m F^T)^† by rewrite pseudo_inverse_sym // trmx_mul trmxK.
case: (pseudo_inverseP (F *m F^T)) => gg' g'g sgg' sg'g; apply: pseudo_inverse_eq.
move: ((F *m F^T)^†) sG gg' g'g sgg' sg'g => Z sZ gZg ZgZ sgZ sZg.
split; rewrite ?mulmxA //.
- have e : F *m F^T *m Z *m F - F = (F *m F^T *m Z - 1%:M) *m F by rewrite mulmxBl mul1mx.
  apply/eqP; rewrite -subr_eq0 e; apply/eqP/gram_eq0.
  by rewrite [(_ *m F)^T]trmx_mul mulmxA -(mulmxA _ F) [(_ - _) *m (F *m _)]mulmxBl gZg mul1mx subrr mul0mx.
- by rewrite -!mulmxA; congr (_ *m _); rewrite !mulmxA -[RHS]ZgZ !mulmxA.
by rewrite tr_mul3 trmxK sZ.
Qed.

(** Semidefinite matrices have semidefinite pseudo-inverses. *)
Theorem psd_pseudo_inverse n (A : 'M[R]_n) : psd A -> psd A^†.
Proof.
move=> pA; have e : A^† = A^† *m A *m A^†^T by rewrite pseudo_inverse_sym ?psd_sym // pseudo_inverse_mulmx.
by rewrite e; apply: psd_congruence.
Qed.

End Laws.
