(** * The Riccati map

    A step is x₊ = A x + w, y = C x + v, where N = [[Q, S], [Sᵀ, V]] ⪰ 0 is the joint covariance of (w, v): correlated
    noises and singular innovations are allowed.

      stack A C P N     [A; C] P [A; C]ᵀ + N, the joint covariance of (x₊, y) if P is that of x
      riccati A C N P   its Schur complement: the covariance of x₊ given y
      riccati_gain      its gain
      joseph A C N P K  what any gain K makes of P
      closed A C K      A − K C, the matrix of the closed loop

    This is the timing *departing* (HV): y tells of x. In the timing *arriving* (CKS) y = C x₊ + v tells of x₊; it is the
    same step with C A for C and the noise (w, C w + v), [arriving_noise]. Source: CKS, HV, AK, WG; EK-L1 to EK-L4. *)

From mathcomp Require Import all_ssreflect all_algebra.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Fact bracket_low_sum (V : zmodType) (a b c f : V) : a + c - f - (a - b) = b + c - f.
Proof. by rewrite opprB addrC -!addrA addKr. Qed.

Fact bracket_high_sum (V : zmodType) (a b c f : V) : a - b - (f - (b + c)) = a + c - f.
Proof. by rewrite opprB -!addrA addKr. Qed.

Section Riccati.
Variables (R : realFieldType) (n p : nat).
Variables (A : 'M[R]_n) (C : 'M[R]_(p, n)) (N : 'M[R]_(n + p)).
Implicit Types (P T : 'M[R]_n) (K : 'M[R]_(n, p)).

Definition stack P := col_mx A C *m P *m (col_mx A C)^T + N.
Definition riccati P := schur (stack P).
Definition riccati_gain P := gain (stack P).
Definition joseph P K := residual (stack P) K.
Definition closed K := A - K *m C.

Lemma stack_blocks P :
  stack P = block_mx (A *m P *m A^T) (A *m P *m C^T) (C *m P *m A^T) (C *m P *m C^T) + N.
Proof. by rewrite /stack mul_col_mx tr_col_mx mul_col_row. Qed.

(** HV-P.c: the cross covariance is Γ = APCᵀ + S. *)
Theorem stack_xy P : Jxy (stack P) = A *m P *m C^T + ursubmx N.
Proof. by rewrite stack_blocks JxyD /Jxy block_mxKur. Qed.

(** HV-P.b: the innovation covariance is Σ = CPCᵀ + V. *)
Theorem stack_yy P : Jyy (stack P) = C *m P *m C^T + drsubmx N.
Proof. by rewrite stack_blocks JyyD /Jyy block_mxKdr. Qed.

(** HV-P.a, CKS-R: the predicted covariance is APAᵀ + Q. *)
Theorem stack_xx P : Jxx (stack P) = A *m P *m A^T + ulsubmx N.
Proof. by rewrite stack_blocks JxxD /Jxx block_mxKul. Qed.

Lemma closed_row K : row_mx 1%:M (- K) *m col_mx A C = closed K.
Proof. by rewrite mul_row_col mul1mx mulNmx. Qed.

(** EK-L1: J(P, K) = (A − KC)P(A − KC)ᵀ + [I −K]N[I −K]ᵀ, for every P, symmetric or not. *)
Theorem josephE P K : joseph P K = closed K *m P *m (closed K)^T + residual N K.
Proof.
rewrite /joseph /stack residualD -closed_row; congr (_ + _).
by rewrite /residual [(_ *m col_mx A C)^T]trmx_mul !mulmxA.
Qed.

Lemma stack_cross P K L :
  row_mx 1%:M (- K) *m stack P *m (row_mx 1%:M (- L))^T =
  closed K *m P *m (closed L)^T + row_mx 1%:M (- K) *m N *m (row_mx 1%:M (- L))^T.
Proof. by rewrite /stack mulmxDr mulmxDl -!closed_row [(_ *m col_mx A C)^T]trmx_mul !mulmxA. Qed.

Lemma stackD P T : stack (P + T) = col_mx A C *m T *m (col_mx A C)^T + stack P.
Proof. by rewrite /stack mulmxDr mulmxDl -addrA addrCA. Qed.

Lemma stack_mono P T : P ⪯ T -> stack P ⪯ stack T.
Proof. by move=> PT; rewrite /stack opprD addrACA subrr addr0; apply: congruence_mono. Qed.

Hypothesis psdN : psd N.

Lemma psd_stack P : psd P -> psd (stack P).
Proof. by move=> pP; apply: psdD => //; apply: psd_congruence. Qed.

(** EK-L2: ΓΣ⁺Σ = Γ for the matrices of a step. *)
Theorem riccati_range P : psd P ->
  (A *m P *m C^T + ursubmx N) *m (C *m P *m C^T + drsubmx N)^† *m (C *m P *m C^T + drsubmx N)
  = A *m P *m C^T + ursubmx N.
Proof. by move=> /psd_stack pJ; rewrite -stack_xy -stack_yy joint_range. Qed.

(** HV-4, HV-5, HV-P.cov: the map written out, APAᵀ + Q − ΓΣ⁺Γᵀ, with gain ΓΣ⁺. *)
Theorem riccatiE P : psd P ->
  riccati P = A *m P *m A^T + ulsubmx N
    - riccati_gain P *m (A *m P *m C^T + ursubmx N)^T /\
  riccati_gain P = (A *m P *m C^T + ursubmx N) *m (C *m P *m C^T + drsubmx N)^†.
Proof.
move=> /psd_stack pJ; split; last by rewrite /riccati_gain /gain stack_xy stack_yy.
by rewrite /riccati /schur JyxE // -stack_xy -stack_xx.
Qed.

(** EK-L3: with the gain of the step, the form of Joseph is the map itself. *)
Theorem riccati_joseph P : psd P -> riccati P = joseph P (riccati_gain P).
Proof. by move=> /psd_stack pJ; rewrite /joseph residual_gain. Qed.

(** For P ⪰ 0 the Lyapunov form, with the closed loop A − KC of the gain of the step. *)
Theorem riccati_lyapunov P : psd P ->
  riccati P = closed (riccati_gain P) *m P *m (closed (riccati_gain P))^T + residual N (riccati_gain P).
Proof. by move=> pP; rewrite riccati_joseph // josephE. Qed.

(** Covariances remain covariances. *)
Theorem riccati_psd P : psd P -> psd (riccati P).
Proof. by move=> pP; apply/schur_psd/psd_stack. Qed.

(** EK-L3: every gain is an upper bound. *)
Theorem riccati_upper P K : psd P -> riccati P ⪯ joseph P K.
Proof. by move=> /psd_stack; apply: schur_optimal. Qed.

(** EK-L3: J(P, K) − φ(P) = (KΣ − Γ)Σ⁺(KΣ − Γ)ᵀ. *)
Theorem riccati_defect P K : psd P ->
  let Sigma := C *m P *m C^T + drsubmx N in let Gamma := A *m P *m C^T + ursubmx N in
  joseph P K - riccati P = (K *m Sigma - Gamma) *m Sigma^† *m (K *m Sigma - Gamma)^T.
Proof. by move=> /psd_stack pJ /=; rewrite -stack_xy -stack_yy gain_defect. Qed.

(** An observation never hurts: φ(P) ⪯ APAᵀ + Q. *)
Theorem riccati_le_prediction P : psd P -> riccati P ⪯ A *m P *m A^T + ulsubmx N.
Proof. by move=> /psd_stack pJ; rewrite -stack_xx; apply: schur_le. Qed.

(** EK-L4: the map is monotone in the order of Loewner. *)
Theorem riccati_mono P T : psd P -> P ⪯ T -> riccati P ⪯ riccati T.
Proof. by move=> pP PT; apply: schur_mono (psd_stack pP) (stack_mono PT). Qed.

(** The noise is never filtered away: schur N ⪯ φ(P). *)
Theorem riccati_ge_noise P : psd P -> schur N ⪯ riccati P.
Proof.
by move=> pP; apply: schur_mono => //; rewrite /stack addrK; apply: psd_congruence.
Qed.

(** EK-L4: the map is concave. *)
Theorem riccati_concave a P T : 0 <= a -> a <= 1 -> psd P -> psd T ->
  a *: riccati P + (1 - a) *: riccati T ⪯ riccati (a *: P + (1 - a) *: T).
Proof.
move=> a0 a1 pP pT; rewrite /riccati.
have -> : stack (a *: P + (1 - a) *: T) = a *: stack P + (1 - a) *: stack T.
  rewrite /stack !scalerDr addrACA -scalerDl addrCA subrr addr0 scale1r.
  by rewrite mulmxDr mulmxDl -!scalemxAr -!scalemxAl.
by apply: schur_concave => //; apply: psd_stack.
Qed.

(** Shrinking P by a shrinks the map by less: aφ(P) + (1 − a) schur N ⪯ φ(aP). *)
Theorem riccati_subhomogeneous a P : 0 <= a -> a <= 1 -> psd P ->
  a *: riccati P + (1 - a) *: schur N ⪯ riccati (a *: P).
Proof.
move=> a0 a1 pP; have e : riccati 0 = schur N by rewrite /riccati /stack mulmx0 mul0mx add0r.
have := riccati_concave a0 a1 pP (psd0 R n); by rewrite scaler0 addr0 e.
Qed.

(** The difference exactly: φ(P) − φ(T) = D₁(P − T)D₂ᵀ with the closed loops D₁ of P and D₂ of T. *)
Theorem riccati_difference P T : psd P -> psd T ->
  riccati P - riccati T = closed (riccati_gain P) *m (P - T) *m (closed (riccati_gain T))^T.
Proof.
move=> pP pT; rewrite {1}/riccati -(residual_cross (riccati_gain T) (psd_stack pP)) -/(riccati_gain P).
have -> : riccati T = row_mx 1%:M (- riccati_gain P) *m stack T *m (row_mx 1%:M (- riccati_gain T))^T.
  have pJ := psd_stack pT; rewrite /riccati -[LHS]psd_sym; last exact: schur_psd.
  by rewrite -(residual_cross (riccati_gain P) pJ) tr_mul3 trmxK (psd_sym pJ).
by rewrite !stack_cross opprD addrACA subrr addr0 -mulmxBl -mulmxBr.
Qed.

(** EK-L4: (A − K′C)(P′ − P)(A − K′C)ᵀ ⪯ φ(P′) − φ(P), K′ the gain at P′; no order between P and P′ is needed. *)
Theorem riccati_bracket_low P P' : psd P -> psd P' ->
  closed (riccati_gain P') *m (P' - P) *m (closed (riccati_gain P'))^T ⪯ riccati P' - riccati P.
Proof.
move=> pP pP'; rewrite (riccati_lyapunov pP') mulmxBr mulmxBl bracket_low_sum -josephE.
exact: riccati_upper.
Qed.

(** EK-L4: φ(P′) − φ(P) ⪯ (A − KC)(P′ − P)(A − KC)ᵀ, K the gain at P. *)
Theorem riccati_bracket_high P P' : psd P -> psd P' ->
  riccati P' - riccati P ⪯ closed (riccati_gain P) *m (P' - P) *m (closed (riccati_gain P))^T.
Proof.
move=> pP pP'; rewrite (riccati_lyapunov pP) mulmxBr mulmxBl bracket_high_sum -josephE.
exact: riccati_upper.
Qed.

End Riccati.

(** More noise, more covariance. *)
Theorem riccati_mono_noise (R : realFieldType) n p (A : 'M[R]_n) (C : 'M[R]_(p, n)) (N N' : 'M[R]_(n + p)) P :
  psd N -> N ⪯ N' -> psd P -> riccati A C N P ⪯ riccati A C N' P.
Proof.
move=> pN NN pP; apply: schur_mono; first exact: psd_stack.
by rewrite /stack opprD addrACA subrr add0r.
Qed.

(** The timing of CKS: x₊ = A x + D w, y = C x₊ + F w with noise w of covariance I. *)
Section Arriving.
Variables (R : realFieldType) (n p q : nat).
Variables (A : 'M[R]_n) (C : 'M[R]_(p, n)) (D : 'M[R]_(n, q)) (F : 'M[R]_(p, q)).
Implicit Types P : 'M[R]_n.

Definition arriving_noise := col_mx D (F + C *m D) *m (col_mx D (F + C *m D))^T.
Definition arriving_stack P := stack A (C *m A) arriving_noise P.
Definition arriving P := riccati A (C *m A) arriving_noise P.
Definition predicted P := A *m P *m A^T + D *m D^T.

Lemma psd_arriving_noise : psd arriving_noise.
Proof. exact: psd_gram. Qed.

Lemma arriving_noise_blocks : arriving_noise =
  block_mx (D *m D^T) (D *m (F + C *m D)^T) ((F + C *m D) *m D^T) ((F + C *m D) *m (F + C *m D)^T).
Proof. by rewrite /arriving_noise tr_col_mx mul_col_row. Qed.

(** CKS-10: Pxy = APAᵀCᵀ + D(F + CD)ᵀ, the block of the stacked covariance. *)
Theorem arriving_xy P : Jxy (arriving_stack P) = A *m P *m A^T *m C^T + D *m (F + C *m D)^T.
Proof. by rewrite stack_xy arriving_noise_blocks block_mxKur (trmx_mul C A) mulmxA. Qed.

(** CKS-10.form: APAᵀCᵀ + D(F + CD)ᵀ = RCᵀ + DFᵀ. *)
Theorem arriving_xy_form P : Jxy (arriving_stack P) = predicted P *m C^T + D *m F^T.
Proof.
rewrite arriving_xy /predicted mulmxDl linearD /= (trmx_mul C D) (mulmxDr D) (mulmxA D).
by rewrite -addrA (addrC (D *m F^T)).
Qed.

(** CKS-11: Pyy = CAPAᵀCᵀ + (F + CD)(F + CD)ᵀ, the block of the stacked covariance. *)
Theorem arriving_yy P :
  Jyy (arriving_stack P) = C *m A *m P *m A^T *m C^T + (F + C *m D) *m (F + C *m D)^T.
Proof. by rewrite stack_yy arriving_noise_blocks block_mxKdr (trmx_mul C A) mulmxA. Qed.

(** CKS-11: it is the bracket CRCᵀ + FFᵀ + CDFᵀ + FDᵀCᵀ of the gain. *)
Theorem arriving_yy_form P :
  Jyy (arriving_stack P) = C *m predicted P *m C^T + F *m F^T + C *m D *m F^T + F *m D^T *m C^T.
Proof.
rewrite arriving_yy /predicted linearD /= (trmx_mul C D) !mulmxDl !mulmxDr !mulmxDl !mulmxA.
set a := _ *m A^T *m C^T; set b := F *m F^T; set c := F *m D^T *m C^T.
rewrite -!addrA; congr (_ + _); rewrite [RHS]addrCA; congr (_ + _).
by rewrite [LHS]addrA [LHS]addrC (addrC c).
Qed.

(** CKS-K: K = (RCᵀ + DFᵀ)(CRCᵀ + FFᵀ + CDFᵀ + FDᵀCᵀ)⁺ is the gain of the step. *)
Theorem arriving_gain P : gain (arriving_stack P) =
  (predicted P *m C^T + D *m F^T) *m (C *m predicted P *m C^T + F *m F^T + C *m D *m F^T + F *m D^T *m C^T)^†.
Proof. by rewrite /gain arriving_xy_form arriving_yy_form. Qed.

(** CKS-12: the Schur complement, which is how P₊ is defined here, is R − Pxy Pyy⁺ Pyx. *)
Theorem arriving_schur P : arriving P =
  predicted P - Jxy (arriving_stack P) *m (Jyy (arriving_stack P))^† *m Jyx (arriving_stack P).
Proof.
rewrite /arriving /riccati /schur; congr (_ - _).
by rewrite stack_xx arriving_noise_blocks block_mxKul.
Qed.

(** CKS-4: P₊ = R − K(CR + FDᵀ) with the gain K of CKS-K. *)
Theorem arriving_covariance P : psd P ->
  arriving P = predicted P - gain (arriving_stack P) *m (C *m predicted P + F *m D^T).
Proof.
move=> pP; have pJ : psd (arriving_stack P) by apply: psd_stack => //; apply: psd_arriving_noise.
have sR : (predicted P)^T = predicted P.
  by apply: psd_sym; apply: psdD; [apply: psd_congruence | apply: psd_gram].
rewrite arriving_schur JyxE // {2}arriving_xy_form; congr (_ - _ *m _).
by rewrite linearD /= (trmx_mul D) (trmx_mul (predicted P)) !trmxK sR.
Qed.

(** The arriving timing too keeps covariances semidefinite. *)
Theorem arriving_psd P : psd P -> psd (arriving P).
Proof. by move=> pP; apply: riccati_psd => //; apply: psd_arriving_noise. Qed.

(** EK-L4: the arriving timing too is monotone. *)
Theorem arriving_mono P T : psd P -> P ⪯ T -> arriving P ⪯ arriving T.
Proof. by move=> pP PT; apply: riccati_mono => //; apply: psd_arriving_noise. Qed.

(** An observation never hurts: P₊ ⪯ R. *)
Theorem arriving_le_predicted P : psd P -> arriving P ⪯ predicted P.
Proof.
move=> pP; have e : ulsubmx arriving_noise = D *m D^T by rewrite arriving_noise_blocks block_mxKul.
by rewrite /predicted -e; apply: riccati_le_prediction => //; apply: psd_arriving_noise.
Qed.

End Arriving.
