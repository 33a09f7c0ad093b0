(** * Fixed points of the Riccati map

    T is a fixed point if T = φ(T). Nothing here says that there is one: in general it is irrational. What is proved is
    all that follows once it stands in the field: it is the only one, every orbit converges to it, at a rate that is
    written down, and matrices with φ(U) ⪯ U or L ⪯ φ(L) enclose it.

    The hypothesis is schur N ≻ 0: given the noise of the reading, the noise of the state is definite. For uncorrelated
    noises this is V ≻ 0 of AK. Source: AK, section 4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From mathcomp.real_closed Require Import complex.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint Riccati ParallelSum Trace Stein.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Orbits.
Variables (R : realFieldType) (n p : nat) (A : 'M[R]_n) (C : 'M[R]_(p, n)) (N : 'M[R]_(n + p)).
Hypothesis psdN : psd N.
Implicit Types P T U L : 'M[R]_n.

Let phi := riccati A C N.

Lemma iter_psd P k : psd P -> psd (iter k phi P).
Proof. by move=> pP; elim: k => //= k; apply: riccati_psd. Qed.

Lemma iter_mono P T k : psd P -> P ⪯ T -> iter k phi P ⪯ iter k phi T.
Proof. by move=> pP PT; elim: k => //= k; apply: riccati_mono => //; apply: iter_psd. Qed.

Lemma iter_down U k : psd U -> phi U ⪯ U -> iter k.+1 phi U ⪯ iter k phi U.
Proof. by move=> pU UU; rewrite iterSr; apply: iter_mono => //; apply: riccati_psd. Qed.

Lemma iter_up L k : psd L -> L ⪯ phi L -> iter k phi L ⪯ iter k.+1 phi L.
Proof. by move=> pL LL; rewrite iterSr; apply: iter_mono. Qed.

Lemma iter_below U k : psd U -> phi U ⪯ U -> iter k phi U ⪯ U.
Proof.
move=> pU UU; elim: k => [|k IH]; first exact: loewner_refl.
exact: loewner_trans (iter_down k pU UU) IH.
Qed.

Lemma iter_above L k : psd L -> L ⪯ phi L -> L ⪯ iter k phi L.
Proof.
move=> pL LL; elim: k => [|k IH]; first exact: loewner_refl.
exact: loewner_trans IH (iter_up k pL LL).
Qed.

Hypothesis pdN : pd (schur N).

Lemma fixed_pd T : psd T -> T = phi T -> pd T.
Proof. by move=> pT {1}->; apply: pd_le pdN _; apply: riccati_ge_noise. Qed.

(** AK-L4.3: a fixed point is a certificate of its own closed loop: T − DTDᵀ ⪰ schur N ≻ 0. *)
Theorem fixed_certificate T : psd T -> T = phi T ->
  let D := closed A C (riccati_gain A C N T) in schur N ⪯ T - D *m T *m D^T.
Proof.
move=> pT eT /=; rewrite {1}eT /phi riccati_lyapunov // [_ + residual _ _]addrC addrK.
exact: schur_optimal.
Qed.

Theorem fixed_contraction T : psd T -> T = phi T -> contraction (closed A C (riccati_gain A C N T)).
Proof. by move=> pT eT; exists T => //; apply: pd_le pdN _; apply: fixed_certificate. Qed.

(** AK-T2.3: the uniqueness: with correlated noises and singular innovations too, there is at most one semidefinite fixed point. *)
Theorem fixed_point_unique T1 T2 : psd T1 -> psd T2 -> T1 = phi T1 -> T2 = phi T2 -> T1 = T2.
Proof.
move=> p1 p2 e1 e2; apply/eqP; rewrite -subr_eq0; apply/eqP.
apply: stein_unique0 (fixed_contraction p1 e1) (fixed_contraction p2 e2) _.
by rewrite {1}e1 {1}e2; apply: riccati_difference.
Qed.

Section Rate.
Variables (T : 'M[R]_n) (e : R).
Hypotheses (pT : psd T) (eT : T = phi T) (e0 : 0 < e) (e1 : e <= 1) (eN : e *: T ⪯ schur N).

Let r0 : 0 <= 1 - e. Proof. by rewrite subr_ge0. Qed.

(** AK-T2.3: one step from below: aT ⪯ P gives (1 − (1 − a)(1 − e))T ⪯ φ(P), where eT ⪯ schur N. *)
Theorem step_from_below a P : 0 <= a -> a <= 1 -> a *: T ⪯ P -> (1 - (1 - a) * (1 - e)) *: T ⪯ phi P.
Proof.
move=> a0 a1 aP; have b0 : 0 <= 1 - a by rewrite subr_ge0.
apply: (@loewner_trans _ _ (phi (a *: T))); last by apply: riccati_mono => //; apply: psdZ.
apply: (@loewner_trans _ _ (a *: T + (1 - a) *: schur N)); last first.
  by rewrite {2}eT; apply: riccati_subhomogeneous.
have -> : 1 - (1 - a) * (1 - e) = a + (1 - a) * e by ring.
rewrite [(a + _) *: T]scalerDl -scalerA; apply: loewnerD; first exact: loewner_refl.
exact: loewnerZ.
Qed.

(** AK-T2.3: one step from above: P ⪯ bT gives φ(P) ⪯ (1 + (b − 1)(1 − e))T. *)
Theorem step_from_above b P : psd P -> 1 <= b -> P ⪯ b *: T -> phi P ⪯ (1 + (b - 1) * (1 - e)) *: T.
Proof.
move=> pP b1 Pb; have b0 : 0 < b by apply: lt_le_trans b1; apply: ltr01.
have bT : psd (b *: T) by apply: psdZ => //; apply: ltW.
have c0 : 0 <= b^-1 by rewrite invr_ge0 ltW.
have c1 : b^-1 <= 1 by rewrite invf_le1.
apply: (@loewner_trans _ _ (phi (b *: T))); first exact: riccati_mono.
have : b^-1 *: phi (b *: T) + (1 - b^-1) *: schur N ⪯ phi (b^-1 *: (b *: T)).
  exact: riccati_subhomogeneous.
rewrite scalerA mulVf ?gt_eqF // scale1r -eT => h.
have {h} h : phi (b *: T) + (b - 1) *: schur N ⪯ b *: T.
  have := loewnerZ (ltW b0) h; rewrite scalerDr !scalerA mulfV ?gt_eqF // scale1r.
  by rewrite mulrBr mulr1 mulfV ?gt_eqF.
have : phi (b *: T) + (b - 1) *: (e *: T) ⪯ b *: T.
  apply: loewner_trans h; apply: loewnerD; first exact: loewner_refl.
  by apply: loewnerZ => //; rewrite subr_ge0.
rewrite scalerA opprD addrA addrAC -scalerBl.
by have -> : b - (b - 1) * e = 1 + (b - 1) * (1 - e) by ring.
Qed.

(** AK-T2.3: if there is a fixed point T, every orbit closes in on it: from any P ⪯ bT, (1 − (1 − e)ᵏ)T ⪯ φᵏ(P) ⪯ (1 + (b − 1)(1 − e)ᵏ)T. *)
Theorem convergence b P k : psd P -> 1 <= b -> P ⪯ b *: T ->
  (1 - (1 - e) ^+ k) *: T ⪯ iter k phi P /\ iter k phi P ⪯ (1 + (b - 1) * (1 - e) ^+ k) *: T.
Proof.
move=> pP b1 Pb; have [r1 g0] : 1 - e <= 1 /\ forall i, 0 <= (1 - e) ^+ i.
  by split=> [|i]; rewrite ?exprn_ge0 // ler_subl_addr ler_addl ltW.
have g1 i : (1 - e) ^+ i <= 1 by apply: exprn_ile1.
elim: k => [|k [lo hi]]; first by rewrite expr0 subrr scale0r subr0 mulr1 addrCA subrr addr0.
split=> /=.
  have := step_from_below _ _ lo; rewrite opprB addrCA subrr addr0 -exprSr; apply.
    by rewrite subr_ge0.
  by rewrite ler_subl_addr ler_addl.
have := step_from_above (iter_psd k pP) _ hi; rewrite [1 + _ - 1]addrC addKr -mulrA -exprSr; apply.
by rewrite ler_addl mulr_ge0 ?subr_ge0.
Qed.

End Rate.

(** Such an e there is. *)
Lemma rate_exists T : psd T -> exists e, [/\ 0 < e, e <= 1 & e *: T ⪯ schur N].
Proof.
move=> pT; have [b b1 Tb] := psd_le_pd pT pdN; have b0 : 0 < b by apply: lt_le_trans b1; apply: ltr01.
have bi : 0 < b^-1 by rewrite invr_gt0.
exists b^-1; split; rewrite ?invf_le1 //.
by have := loewnerZ (ltW bi) Tb; rewrite scalerA mulVf ?gt_eqF // scale1r.
Qed.

End Orbits.

(** Certificates: here the field must be archimedean, as the rationals and the reals are. *)
Section Certificates.
Variables (R : archiFieldType) (n p : nat) (A : 'M[R]_n) (C : 'M[R]_(p, n)) (N : 'M[R]_(n + p)).
Hypotheses (psdN : psd N) (pdN : pd (schur N)).
Variable T : 'M[R]_n.
Hypotheses (pT : psd T) (eT : T = riccati A C N T).

(** AK-4.2-sandwich: φ(U) ⪯ U puts the fixed point below U. *)
Theorem certificate_above U : psd U -> riccati A C N U ⪯ U -> T ⪯ U.
Proof.
move=> pU UU; have [e [e0 e1 eN]] := rate_exists pdN pT.
have [b b1 Ub] := psd_le_pd pU (fixed_pd psdN pdN pT eT).
split=> [|x]; first by rewrite linearB /= (psd_sym pU) (psd_sym pT).
rewrite -oppr_le0 -formN opprB; apply: (geometric_le0 (c := form T x x) e0 e1) => k.
have [lo _] := convergence psdN pT eT e0 e1 eN k pU b1 Ub.
have := (loewner_trans lo (iter_below psdN k pU UU)).2 x.
by rewrite !formB formZ mulrBl mul1r subr_ge0 ler_subl_addr -ler_subl_addl mulrC.
Qed.

(** AK-4.2-sandwich: L ⪯ φ(L) puts it above L. *)
Theorem certificate_below L : psd L -> L ⪯ riccati A C N L -> L ⪯ T.
Proof.
move=> pL LL; have [e [e0 e1 eN]] := rate_exists pdN pT.
have [b b1 Lb] := psd_le_pd pL (fixed_pd psdN pdN pT eT).
split=> [|x]; first by rewrite linearB /= (psd_sym pL) (psd_sym pT).
rewrite -oppr_le0 -formN opprB; apply: (geometric_le0 (c := (b - 1) * form T x x) e0 e1) => k.
have [_ hi] := convergence psdN pT eT e0 e1 eN k pL b1 Lb.
have := (loewner_trans (iter_above psdN k pL LL) hi).2 x.
by rewrite !formB formZ mulrDl mul1r subr_ge0 -ler_subl_addl mulrAC.
Qed.

End Certificates.
