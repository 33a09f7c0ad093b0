(** * Enclosed covariances and means

    A step is x₊ = A x + b + w, y = H x + c + v, with noise of covariance ((Q, S), (Sᵀ, R)); A may be rectangular.

      Gamma P, Sigma P      APHᵀ + S and HPHᵀ + R
      phi P                 APAᵀ + Q − ΓΣ⁺Γᵀ
      joseph P K            what any gain K makes of P, (A − KH)P(A − KH)ᵀ + [I −K] noise [I −K]ᵀ
      domain P              P and Σ are symmetric, Σ ⪰ 0, and ΓΣ⁺Σ = Γ: so it is for P ⪰ 0, and for Σ ≻ 0
      within W Z            −W ⪯ Z ⪯ W

    What is known of the exact covariance P is within W (P − P̃), of the exact mean (x̂ − x̃)(x̂ − x̃)ᵀ ⪯ E. The gain K̃ and the
    matrix T are anything: what they are worth is what κ = 1 − η − w says. P and P̃ may be indefinite.
    Source: EK-L1 to EK-L4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing PositiveSemidefinite PseudoInverse Joint Gaps.
From Kalman Require Riccati.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Step.
Variables (R : realFieldType) (m n p : nat).
Variables (A : 'M[R]_(m, n)) (H : 'M[R]_(p, n)) (Q : 'M[R]_m) (S : 'M[R]_(m, p)) (V : 'M[R]_p).
Implicit Types (P W Z E : 'M[R]_n) (K : 'M[R]_(m, p)).
Hypothesis symV : V^T = V.

Definition Gamma P : 'M[R]_(m, p) := A *m P *m H^T + S.
Definition Sigma P : 'M[R]_p := H *m P *m H^T + V.
Definition phi P : 'M[R]_m := A *m P *m A^T + Q - Gamma P *m (Sigma P)^† *m (Gamma P)^T.
Definition closed K : 'M[R]_(m, n) := A - K *m H.
Definition noise K : 'M[R]_m := Q - S *m K^T - K *m S^T + K *m V *m K^T.
Definition joseph P K : 'M[R]_m := closed K *m P *m (closed K)^T + noise K.
Definition domain P := [/\ P^T = P, psd (Sigma P) & Gamma P *m (Sigma P)^† *m Sigma P = Gamma P].

(** EK-L1: (A − KH)P(A − KH)ᵀ + [I −K]M[I −K]ᵀ = APAᵀ + Q − KΓᵀ − ΓKᵀ + KΣKᵀ, for every symmetric P and every K. *)
Theorem joseph_expand P K : P^T = P ->
  joseph P K = A *m P *m A^T + Q - K *m (Gamma P)^T - Gamma P *m K^T + K *m Sigma P *m K^T.
Proof. by move=> sP; rewrite /joseph /closed /noise /Gamma /Sigma; multiply; rewrite sP; sums. Qed.

Lemma noiseE K : noise K = residual (block_mx Q S S^T V) K.
Proof. by rewrite residual_block /noise; sums. Qed.

Lemma josephD P Z K : joseph (P + Z) K = joseph P K + closed K *m Z *m (closed K)^T.
Proof. by rewrite /joseph; expand. Qed.

(** J(·, K) is monotone, on all symmetric matrices. *)
Theorem joseph_mono P P' K : P ⪯ P' -> joseph P K ⪯ joseph P' K.
Proof.
move=> h; have -> : joseph P' K - joseph P K = closed K *m (P' - P) *m (closed K)^T by rewrite /joseph; expand.
exact: psd_congruence.
Qed.

Lemma Sigma_sym P : P^T = P -> (Sigma P)^T = Sigma P.
Proof. by move=> sP; rewrite /Sigma; multiply; rewrite sP symV. Qed.

Lemma domain_pd P : P^T = P -> pd (Sigma P) -> domain P.
Proof.
move=> sP pS; split=> //; first exact: pd_psd.
by rewrite pseudo_inverse_unit ?pd_unit // mulmxKV ?pd_unit.
Qed.

(** EK-L2: ΓΣ⁺Σ = Γ for P ⪰ 0 and noise with a semidefinite covariance. *)
Theorem domain_psd P : psd (block_mx Q S S^T V) -> psd P -> domain P.
Proof.
move=> pM pP; pose J := col_mx A H *m P *m (col_mx A H)^T + block_mx Q S S^T V.
have pJ : psd J by apply: psdD => //; apply: psd_congruence.
have eJ : J = block_mx (A *m P *m A^T + Q) (Gamma P) (H *m P *m A^T + S^T) (Sigma P).
  by rewrite /J mul_col_mx tr_col_mx mul_col_row add_block_mx.
split; first exact: psd_sym.
  by have := psd_Jyy pJ; rewrite eJ /Jyy block_mxKdr.
by have := joint_range pJ; rewrite eJ /Jyy /Jxy block_mxKdr block_mxKur.
Qed.

Lemma mul_pseudo_inverse k l q (B : 'M[R]_(k, l)) (X : 'M[R]_(l, q)) : B *m X *m X^† *m X = B *m X.
Proof. by rewrite -!mulmxA (mulmxA X) mulmx_pseudo_inverse. Qed.

(** EK-L3: J(P, K) = φ(P) + (K − L)Σ(K − L)ᵀ for every L with LΣ = Γ. *)
Theorem joseph_square P K L : P^T = P -> L *m Sigma P = Gamma P ->
  joseph P K = phi P + (K - L) *m Sigma P *m (K - L)^T.
Proof.
move=> sP eL; have sS := Sigma_sym sP; rewrite joseph_expand // /phi -eL.
rewrite trmx_mul sS !(mulmxA _ (Sigma P)) mul_pseudo_inverse.
by expand.
Qed.

(** EK-L3: J(P, K) − φ(P) = (KΣ − Γ)Σ⁺(KΣ − Γ)ᵀ. *)
Theorem joseph_defect P K : domain P ->
  joseph P K - phi P = (K *m Sigma P - Gamma P) *m (Sigma P)^† *m (K *m Sigma P - Gamma P)^T.
Proof.
case=> sP pS range; have sS := Sigma_sym sP; rewrite (joseph_square K sP range).
set L := Gamma P *m _ in range *.
have -> : K *m Sigma P - Gamma P = (K - L) *m Sigma P by rewrite mulmxBl range.
by rewrite trmx_mul sS !(mulmxA _ (Sigma P)) mul_pseudo_inverse addrC addKr.
Qed.

(** EK-L3: any gain is an upper bound. *)
Theorem phi_le_joseph P K : domain P -> phi P ⪯ joseph P K.
Proof.
case=> sP pS range; rewrite (joseph_square K sP range) addrC addKr.
exact: psd_congruence.
Qed.

(** EK-L3: a gain is as good as the best one if and only if KΣ = Γ. *)
Theorem joseph_least P K : domain P -> joseph P K = phi P <-> K *m Sigma P = Gamma P.
Proof.
move=> dP; case: (dP) => sP pS range; split=> [e|e]; last first.
  by apply/eqP; rewrite -subr_eq0 joseph_defect // e subrr !mul0mx.
set L := Gamma P *m (Sigma P)^† in range.
have z : (K - L) *m Sigma P *m (K - L)^T = 0.
  by apply: (addrI (phi P)); rewrite -joseph_square // addr0.
apply/eqP; rewrite -subr_eq0 -range -mulmxBl; apply/eqP/row_matrixP=> i.
rewrite row0 row_mul; apply: psd_kernel => //.
by rewrite rowE -form_congr z form0.
Qed.

(** EK-L4: φ is monotone. *)
Theorem phi_mono P P' : domain P -> domain P' -> P ⪯ P' -> phi P ⪯ phi P'.
Proof.
move=> dP dP' h; case: (dP') => sP' _ range.
apply: loewner_trans (phi_le_joseph (Gamma P' *m (Sigma P')^†) dP) _.
by have /joseph_least <- // := range; apply: joseph_mono.
Qed.

(** EK-L4: φ(P′) − φ(P) ⪯ (A − KH)(P′ − P)(A − KH)ᵀ for a gain K with KΣ = Γ at P, without an order between P and P′. *)
Theorem phi_bracket P P' K : domain P -> domain P' -> K *m Sigma P = Gamma P ->
  phi P' - phi P ⪯ closed K *m (P' - P) *m (closed K)^T.
Proof.
move=> dP dP' eK; have := phi_le_joseph K dP'; have /(joseph_least _ dP) <- := eK.
by congr psd; rewrite /joseph; expand.
Qed.

(** EK-L4: (A − K′H)(P′ − P)(A − K′H)ᵀ ⪯ φ(P′) − φ(P) for a gain K′ with K′Σ = Γ at P′, without an order between P and P′. *)
Theorem phi_bracket_low P P' K : domain P -> domain P' -> K *m Sigma P' = Gamma P' ->
  closed K *m (P' - P) *m (closed K)^T ⪯ phi P' - phi P.
Proof.
move=> d d' eK; have := phi_bracket d' d eK.
have -> : P - P' = - (P' - P) by rewrite opprB.
rewrite mulmxN mulNmx; set a := _ *m _ *m _.
by have -> : - a - (phi P - phi P') = phi P' - phi P - a by rewrite opprB addrC.
Qed.

Lemma domain_convex P P' a : 0 <= a -> a <= 1 -> domain P -> domain P' ->
  domain (a *: P + (1 - a) *: P').
Proof.
move=> a0 a1 [sP pS eG] [sP' pS' eG'].
have b0 : 0 <= 1 - a by rewrite subr_ge0.
have eS : Sigma (a *: P + (1 - a) *: P') = a *: Sigma P + (1 - a) *: Sigma P'.
  by rewrite /Sigma; multiply; sums.
have eGm : Gamma (a *: P + (1 - a) *: P') = a *: Gamma P + (1 - a) *: Gamma P'.
  by rewrite /Gamma; multiply; sums.
have pm : psd (a *: Sigma P + (1 - a) *: Sigma P') by apply: psdD; apply: psdZ.
split; first by rewrite !(trmxD, trmxZ) sP sP'.
  by rewrite eS.
rewrite eS eGm; set M := _ + _ *: Sigma P'; rewrite -/M in pm.
set k := 1%:M - M^† *m M.
suff ker (X : 'M[R]_n) c : psd (Sigma X) -> Gamma X *m (Sigma X)^† *m Sigma X = Gamma X ->
    0 <= c -> c *: Sigma X ⪯ M -> c *: Gamma X *m k = 0.
  have e : (a *: Gamma P + (1 - a) *: Gamma P') *m k = 0.
    rewrite mulmxDl !ker ?addr0 // /M.
      by rewrite addrK; apply: psdZ.
    by rewrite addrAC subrr add0r; apply: psdZ.
  by move: e; rewrite mulmxBr mulmx1 mulmxA => /eqP; rewrite subr_eq0 => /eqP <-.
move=> pX eX c0 le; rewrite -scalemxAl -eX.
suff z : c *: (Sigma X *m k) = 0 by rewrite -!mulmxA scalemxAr scalemxAr z !mulmx0.
have pc : psd (c *: Sigma X) by apply: psdZ.
have z2 : k^T *m (c *: Sigma X) *m k = 0.
  have top : k^T *m M *m k = 0.
    by rewrite -mulmxA /k mulmxBr mulmx1 mulmxA mulmx_pseudo_inverse subrr mulmx0.
  apply: loewner_antisym.
    by have := congruence_mono k^T le; rewrite trmxK top.
  by rewrite subr0; have := psd_congruence k^T pc; rewrite trmxK.
rewrite scalemxAl -[LHS]trmxK; apply: (canLR (@trmxK _ _ _)); rewrite trmx0 trmx_mul (psd_sym pc).
apply/row_matrixP => i; rewrite row0 row_mul; apply: psd_kernel => //.
have : form (k^T *m (c *: Sigma X) *m k^T^T) (delta_mx 0 i) (delta_mx 0 i) = 0 by rewrite trmxK z2 form0.
by rewrite form_congr -rowE.
Qed.

(** EK-L4: φ is concave. *)
Theorem phi_concave P P' a : 0 <= a -> a <= 1 -> domain P -> domain P' ->
  a *: phi P + (1 - a) *: phi P' ⪯ phi (a *: P + (1 - a) *: P').
Proof.
move=> a0 a1 dP dP'; have d := domain_convex a0 a1 dP dP'; case: (d) => _ _ /(joseph_least _ d) <-; set K := Gamma _ *m _.
have -> : joseph (a *: P + (1 - a) *: P') K = a *: joseph P K + (1 - a) *: joseph P' K.
  by rewrite /joseph; expand.
by apply: loewnerD; apply: loewnerZ; rewrite ?subr_ge0 //; apply: phi_le_joseph.
Qed.

End Step.

(** For a square A and P ⪰ 0 the map is that of Riccati.v. *)
Theorem phi_riccati (R : realFieldType) n p (A : 'M[R]_n) (H : 'M[R]_(p, n)) Q S V P :
  psd (block_mx Q S S^T V) -> psd P -> phi A H Q S V P = Riccati.riccati A H (block_mx Q S S^T V) P.
Proof.
move=> pN pP; have [-> ->] := Riccati.riccatiE A H pN pP.
by rewrite block_mxKul block_mxKur block_mxKdr.
Qed.
