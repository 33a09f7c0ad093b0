(** * What a certificate of a step proves

    Beside the gain K̃ a certificate brings a matrix T. With η no less than the row sums of |TΣ̃Tᵀ − I|, w ≥ tr(T HWHᵀ Tᵀ)
    and κ = 1 − η − w > 0 the innovation is regular, and the covariance, the mean and the gain
    are as near to what was computed as the theorems below say. Source: EK-L7, EK-T1, EK-T2, EK-D1. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing PositiveSemidefinite PseudoInverse Joint Gaps Enclosure.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Whitening.
Variables (R : realFieldType) (n p : nat).
Variables (H : 'M[R]_(p, n)) (V : 'M[R]_p) (T : 'M[R]_p) (P Pt W : 'M[R]_n) (eta w : R).
Hypotheses (symV : V^T = V) (symPt : Pt^T = Pt) (gap : within W (P - Pt)).
Let E := T *m Sigma H V Pt *m T^T - 1%:M.
Hypotheses (eta_row : forall i, \sum_j `|E i j| <= eta) (w_trace : \tr (T *m (H *m W *m H^T) *m T^T) <= w).
Let kappa := 1 - eta - w.
Hypothesis kappa_gt0 : 0 < kappa.

Let symP : P^T = P.
Proof.
by have [sZ _] := within_sym gap; rewrite -[P](subrK Pt) trmxD sZ symPt.
Qed.

(** A symmetric matrix is between ± its largest row sum. *)
Lemma within_row_sums : within (eta%:M) E.
Proof.
have sE : E^T = E by rewrite /E trmxD trmxN trmx1 tr_congr // Sigma_sym.
have := @rounding R p E (\matrix_(i, j) `|E i j|) (fun=> 1) sE.
move=> h; have/h{h} : (\matrix_(i, j) `|E i j|)^T = \matrix_(i, j) `|E i j|.
  by apply/matrixP=> i j; rewrite [LHS]mxE [LHS]mxE [RHS]mxE -{2}sE [E^T _ _]mxE.
move=> h; apply: within_le (h _ _ _) _ => [_|i j|i j|]; rewrite ?mxE ?mulr1 ?ler01 ?normr_ge0 //.
split=> [|x]; first by rewrite trmxD trmxN tr_scalar_mx tr_diag_mx.
rewrite -diag_const_mx -raddfB /= /form mul_mx_diag mxE; apply: sumr_ge0 => i _.
rewrite !mxE expr1n mul1r mulrAC -expr2 mulr_ge0 ?sqr_ge0 // subr_ge0.
by under eq_bigr => j _ do rewrite mxE; apply: eta_row.
Qed.

Let gap_seen : within w%:M (T *m (H *m (P - Pt) *m H^T) *m T^T).
Proof.
apply: within_le (within_congruence T (within_congruence H gap)) _.
apply: loewner_trans (psd_le_trace _) _; first by apply/psd_congruence/psd_congruence/(within_psd gap).
rewrite -raddfB /= -[_%:M]scalemx1; apply: psdZ; [by rewrite subr_ge0 | exact: psd1].
Qed.

(** EK-L7: TΣTᵀ ⪰ κI for every P of the set. *)
Theorem whitened : kappa%:M ⪯ T *m Sigma H V P *m T^T.
Proof.
have [h1 _] := withinD within_row_sums gap_seen.
have e : kappa%:M = 1%:M - eta%:M - w%:M :> 'M[R]_p by rewrite /kappa !raddfB.
have -> : T *m Sigma H V P *m T^T - kappa%:M = E + T *m (H *m (P - Pt) *m H^T) *m T^T - - (eta%:M + w%:M).
  by rewrite e /E /Sigma; expand.
exact: h1.
Qed.

Let pd_whitened : pd (T *m Sigma H V P *m T^T).
Proof.
apply: pd_le whitened; rewrite -scalemx1; apply: pdZ => //; exact: pd1.
Qed.

(** EK-L7: T is regular. *)
Theorem whitening_regular : T \in unitmx.
Proof. by have := pd_unit pd_whitened; rewrite !unitmx_mul -andbA => /andP[]. Qed.

Let back X : invmx T *m (T *m X *m T^T) *m (invmx T)^T = X.
Proof.
have uT := whitening_regular.
by rewrite !mulmxA mulVmx // mul1mx -mulmxA trmx_inv mulmxV ?mulmx1 // unitmx_tr.
Qed.

(** EK-L7: Σ is definite. *)
Theorem innovation_pd : pd (Sigma H V P).
Proof.
rewrite -[Sigma H V P]back; apply: pd_congruence => //.
by rewrite row_free_unit unitmx_inv whitening_regular.
Qed.

(** EK-L7: Σ⁻¹ ⪯ TᵀT/κ. *)
Theorem innovation_inverse : invmx (Sigma H V P) ⪯ kappa^-1 *: (T^T *m T).
Proof.
have uT := whitening_regular; have uTt : T^T \in unitmx by rewrite unitmx_tr.
have uS := pd_unit innovation_pd.
have pk : pd (kappa%:M : 'M[R]_p) by rewrite -scalemx1; apply: pdZ => //; exact: pd1.
have := congruence_mono T^T (pd_inv_antitone pk whitened).
rewrite trmxK; set X := invmx (T *m _ *m _).
have -> : T^T *m X *m T = invmx (Sigma H V P).
  rewrite -[LHS](mulmxK uS) -[RHS]mul1mx; congr (_ *m invmx _).
  have -> : T^T *m X *m T *m Sigma H V P = T^T *m (X *m (T *m Sigma H V P *m T^T)) *m invmx T^T.
    by rewrite !mulmxA mulmxK.
  by rewrite mulVmx ?pd_unit // mulmx1 mulmxV.
have -> : invmx (kappa%:M) = (kappa^-1)%:M :> 'M[R]_p.
  by rewrite invmx_scalar.
by rewrite mul_mx_scalar -scalemxAl.
Qed.

Let w_ge0 : 0 <= w.
Proof.
apply: le_trans w_trace; have := trace_ge0 _ (psd1 R p); rewrite -[X in \tr X]mulmx1; apply.
by apply/psd_congruence/psd_congruence/(within_psd gap).
Qed.

(** The gap that is seen is small beside Σ: HWHᵀ ⪯ (w/κ)Σ. *)
Theorem gap_of_innovation : H *m W *m H^T ⪯ (w / kappa) *: Sigma H V P.
Proof.
rewrite -[H *m W *m H^T]back -[Sigma H V P]back scalemxAl scalemxAr; apply: congruence_mono.
apply: (@loewner_trans _ _ w%:M).
  apply: loewner_trans (psd_le_trace _) _; first by apply/psd_congruence/psd_congruence/(within_psd gap).
  rewrite -raddfB /= -[_%:M]scalemx1; apply: psdZ; [by rewrite subr_ge0 | exact: psd1].
have -> : w%:M = (w / kappa) *: kappa%:M :> 'M[R]_p.
  by rewrite scale_scalar_mx divfK // lt0r_neq0.
by apply: loewnerZ whitened; rewrite divr_ge0 ?w_ge0 // ltW.
Qed.

(** From EK-L5 and EK-L7, ZHᵀΣ⁻¹HZ ⪯ (w/κ) W for the gap Z = P − P̃. *)
Theorem gap_through_innovation :
  (P - Pt) *m (H^T *m invmx (Sigma H V P) *m H) *m (P - Pt) ⪯ (w / kappa) *: W.
Proof.
have [sZ _] := within_sym gap; have pW := within_psd gap; set Z := P - Pt in sZ *.
have pX : psd (H^T *m T^T *m T *m H) by have := psd_gram (H^T *m T^T); rewrite trmx_mul !trmxK mulmxA.
apply: (@loewner_trans _ _ (kappa^-1 *: (Z *m (H^T *m T^T *m T *m H) *m Z))).
  have -> : kappa^-1 *: (Z *m (H^T *m T^T *m T *m H) *m Z) - Z *m (H^T *m invmx (Sigma H V P) *m H) *m Z
          = Z *m H^T *m (kappa^-1 *: (T^T *m T) - invmx (Sigma H V P)) *m (Z *m H^T)^T.
    by clearbody Z; multiply; rewrite sZ; sums.
  exact/psd_congruence/innovation_inverse.
rewrite mulrC -scalerA; apply: loewnerZ; first by rewrite invr_ge0 ltW.
apply: loewner_trans (gap_square gap pX) _; rewrite -scalerBl; apply: psdZ pW.
rewrite subr_ge0; apply: le_trans w_trace.
have -> : T *m (H *m W *m H^T) *m T^T = T *m H *m W *m (T *m H)^T by rewrite trmx_mul !mulmxA.
by rewrite [X in _ <= X]mxtrace_mulC trmx_mul !mulmxA.
Qed.

End Whitening.

Section Step.
Variables (R : realFieldType) (m n p : nat).
Variables (A : 'M[R]_(m, n)) (H : 'M[R]_(p, n)) (Q : 'M[R]_m) (S : 'M[R]_(m, p)) (V : 'M[R]_p).
Variables (T : 'M[R]_p) (P Pt W : 'M[R]_n) (K : 'M[R]_(m, p)) (eta w : R).
Hypotheses (symV : V^T = V) (symPt : Pt^T = Pt) (gap : within W (P - Pt)).
Hypothesis eta_row : forall i, \sum_j `|(T *m Sigma H V Pt *m T^T - 1%:M) i j| <= eta.
Hypothesis w_trace : \tr (T *m (H *m W *m H^T) *m T^T) <= w.
Let kappa := 1 - eta - w.
Hypothesis kappa_gt0 : 0 < kappa.

Let Z := P - Pt.
Let C := closed A H K.
Let rho := K *m Sigma H V Pt - Gamma A H S Pt.
Let L := Gamma A H S P *m invmx (Sigma H V P).
Let si := invmx (Sigma H V P).

Let symP : P^T = P.
Proof. by have [sZ _] := within_sym gap; rewrite -[P](subrK Pt) trmxD sZ symPt. Qed.
Let symZ : Z^T = Z. Proof. by have [] := within_sym gap. Qed.
Let pdS : pd (Sigma H V P). Proof. exact: innovation_pd gap eta_row w_trace kappa_gt0. Qed.
Let dom : domain A H S V P. Proof. exact: domain_pd. Qed.
Let unitS : Sigma H V P \in unitmx. Proof. exact: pd_unit. Qed.
Let psd_si : psd si. Proof. exact/pd_psd/pd_inv. Qed.
Let eL : L *m Sigma H V P = Gamma A H S P. Proof. by rewrite mulmxKV. Qed.

(** The defect of the gain at P by what is computed at P̃: K̃Σ − Γ = ρ − (A − K̃H)ZHᵀ. *)
Lemma defect_moved : (K - L) *m Sigma H V P = rho - C *m Z *m H^T.
Proof. by rewrite mulmxBl eL /rho /C /closed /Z /Sigma /Gamma; expand. Qed.

Definition spread : 'M[R]_m := (2%:R / kappa) *: (rho *m T^T *m T *m rho^T + w *: (C *m W *m C^T)).

(** EK-T1: the loss of the gain, (K̃ − K)Σ(K̃ − K)ᵀ, is at most (2/κ)(ρTᵀTρᵀ + w G̃WG̃ᵀ). *)
Theorem loss_of_gain :
  (K - L) *m Sigma H V P *m (K - L)^T ⪯ spread.
Proof.
have -> : (K - L) *m Sigma H V P *m (K - L)^T
        = (rho - C *m Z *m H^T) *m si *m (rho - C *m Z *m H^T)^T.
  by rewrite -defect_moved trmx_mul (pd_sym pdS) mulmxK // !mulmxA.
apply: loewner_trans (difference_of_two _ _ psd_si) _; rewrite /spread -scalerA; apply: loewnerZ; first exact: ler0n.
rewrite scalerDr scalerA; apply: loewnerD.
  have -> : kappa^-1 *: (rho *m T^T *m T *m rho^T) = rho *m (kappa^-1 *: (T^T *m T)) *m rho^T by rewrite mulmxZr mulmxZl !mulmxA.
  exact/congruence_mono/(innovation_inverse symV symPt gap eta_row w_trace kappa_gt0).
have -> : C *m Z *m H^T *m si *m (C *m Z *m H^T)^T = C *m (Z *m (H^T *m si *m H) *m Z) *m C^T.
  by clearbody Z C; multiply; rewrite symZ.
rewrite mulrC -mulmxZl -mulmxZr; apply: congruence_mono.
exact: gap_through_innovation symV symPt gap eta_row w_trace kappa_gt0.
Qed.

(** EK-T1: φ(P) is within W₊ = (1 + 2w/κ) G̃WG̃ᵀ + (2/κ) ρTᵀTρᵀ of J(P̃, K̃). *)
Theorem enclosed_covariance :
  within ((1 + 2%:R * w / kappa) *: (C *m W *m C^T) + (2%:R / kappa) *: (rho *m T^T *m T *m rho^T))
    (phi A H Q S V P - joseph A H Q S V Pt K).
Proof.
have -> : (1 + 2%:R * w / kappa) *: (C *m W *m C^T) + (2%:R / kappa) *: (rho *m T^T *m T *m rho^T)
        = C *m W *m C^T + spread.
  by rewrite /spread scalerDr scalerA scalerDl scale1r mulrAC -addrA [X in _ + X]addrC.
have e := joseph_square Q symV K symP eL.
have eJ : joseph A H Q S V P K = joseph A H Q S V Pt K + C *m Z *m C^T.
  by rewrite -josephD addrC subrK.
have -> : phi A H Q S V P - joseph A H Q S V Pt K = C *m Z *m C^T - (K - L) *m Sigma H V P *m (K - L)^T.
  by rewrite -[C *m Z *m C^T](addKr (joseph A H Q S V Pt K)) -eJ e; sums.
have [h1 h2] := within_congruence C gap; have h3 := loss_of_gain.
have h0 : psd ((K - L) *m Sigma H V P *m (K - L)^T) by apply/psd_congruence/pd_psd.
split.
  have -> : C *m Z *m C^T - (K - L) *m Sigma H V P *m (K - L)^T - - (C *m W *m C^T + spread)
          = C *m Z *m C^T - - (C *m W *m C^T) + (spread - (K - L) *m Sigma H V P *m (K - L)^T) by sums.
  exact: psdD.
have -> : C *m W *m C^T + spread - (C *m Z *m C^T - (K - L) *m Sigma H V P *m (K - L)^T)
        = C *m W *m C^T - C *m Z *m C^T + spread + (K - L) *m Sigma H V P *m (K - L)^T by sums.
apply: psdD => //; apply: psdD => //; exact: psd_le h0 h3.
Qed.

(** EK-T1: what is within a pad of J(P̃, K̃), as a rounded matrix is, encloses φ(P) with the pad added to W₊. *)
Theorem enclosed_and_rounded (Pr Pad Wr : 'M[R]_m) :
  within Pad (joseph A H Q S V Pt K - Pr) ->
  (1 + 2%:R * w / kappa) *: (C *m W *m C^T) + (2%:R / kappa) *: (rho *m T^T *m T *m rho^T) + Pad ⪯ Wr ->
  within Wr (phi A H Q S V P - Pr).
Proof.
move=> h1 h2; apply: within_le h2; have := withinD enclosed_covariance h1.
by rewrite addrA subrK.
Qed.

Section Mean.
Variables (x xt : 'cV[R]_n) (y c : 'cV[R]_p) (b xr : 'cV[R]_m) (E : 'M[R]_n) (tau2 alpha : R).
Hypotheses (ellipsoid : (x - xt) *m (x - xt)^T ⪯ E) (alpha_gt0 : 0 < alpha).
Let nu := y - c - H *m x.
Let nut := y - c - H *m xt.
Hypothesis tau : (nu^T *m si *m nu) 0 0 <= tau2.
Let err := A *m xt + b + K *m nut - xr.

(** EK-T2: the error of the mean after a step, rounded by err, is in the ellipsoid
    (1 + α) G̃EG̃ᵀ + (1 + 1/α)(3(wτ²/κ) G̃WG̃ᵀ + 3(τ²/κ) ρTᵀTρᵀ + 3εεᵀ), for any τ² ≥ νᵀΣ⁻¹ν; how τ² is found is not here. *)
Theorem enclosed_mean :
  let e := A *m x + b + L *m nu - xr in
  e *m e^T ⪯ (1 + alpha) *: (C *m E *m C^T)
    + (1 + alpha^-1) *: ((3%:R * (w * tau2 / kappa)) *: (C *m W *m C^T)
      + (3%:R * (tau2 / kappa)) *: (rho *m T^T *m T *m rho^T) + 3%:R *: (err *m err^T)).
Proof.
have sym_si : si^T = si := psd_sym psd_si.
pose g := C *m (Z *m H^T *m si *m nu); pose r := rho *m si *m nu.
have eKL : L - K = (C *m Z *m H^T - rho) *m si.
  by rewrite -[LHS](mulmxK unitS) -[L - K]opprB mulNmx defect_moved opprB.
have eE : A *m x + b + L *m nu - xr = C *m (x - xt) + (g - r + err).
  have -> : L = K + (C *m Z *m H^T - rho) *m si by rewrite -eKL addrC subrK.
  by rewrite /g /r /err /nu /nut /C /closed; expand.
have tau0 : 0 <= tau2.
  apply: le_trans tau; have := psd_si.2 nu^T; by rewrite /form trmxK.
have kge : 0 <= kappa^-1 by rewrite invr_ge0 ltW.
move=> e; rewrite /e eE.
have h2 := sum_of_two (C *m (x - xt)) (g - r + err) (psd1 R 1) alpha_gt0; rewrite !mulmx1 in h2.
apply: loewner_trans h2 _; apply: loewnerD.
  apply: loewnerZ; first by rewrite addr_ge0 ?ler01 // ltW.
  have -> : C *m (x - xt) *m (C *m (x - xt))^T = C *m ((x - xt) *m (x - xt)^T) *m C^T.
    by rewrite trmx_mul !mulmxA.
  exact: congruence_mono.
apply: loewnerZ; first by rewrite addr_ge0 ?ler01 // invr_ge0 ltW.
have h3 := sum_of_three g (- r) err (psd1 R 1); rewrite !mulmx1 in h3.
apply: loewner_trans h3 _; rewrite -2!(scalerA 3%:R) -!scalerDr; apply: loewnerZ; first exact: ler0n.
apply: loewnerD; last exact: loewner_refl.
apply: loewnerD.
  have -> : g *m g^T = C *m (Z *m H^T *m si *m nu *m (Z *m H^T *m si *m nu)^T) *m C^T.
    by rewrite /g trmx_mul !mulmxA.
  rewrite -mulmxZl -mulmxZr; apply: congruence_mono.
  pose h : 'rV_n := nu^T *m si *m H.
  have -> : Z *m H^T *m si *m nu *m (Z *m H^T *m si *m nu)^T = Z *m (h^T *m h) *m Z.
    by rewrite /h; clearbody Z nu si; multiply; rewrite sym_si symZ.
  apply: loewner_trans (within_square h gap) _; rewrite -scalerBl; apply: psdZ (within_psd gap).
  have hW : form W h h = form (H *m W *m H^T) (nu^T *m si) (nu^T *m si) by rewrite form_congr.
  rewrite subr_ge0 hW.
  have := (gap_of_innovation symV symPt gap eta_row w_trace kappa_gt0).2 (nu^T *m si).
  rewrite formB formZ subr_ge0 => k; apply: le_trans k _.
  have -> : form (Sigma H V P) (nu^T *m si) (nu^T *m si) = (nu^T *m si *m nu) 0 0.
    by rewrite /form trmx_mul trmxK sym_si -[nu^T *m si *m Sigma H V P]mulmxA mulVmx // mulmx1 mulmxA.
  have w0 : 0 <= w.
    apply: le_trans w_trace; have := trace_ge0 (psd_congruence T (psd_congruence H (within_psd gap))) (psd1 R p).
    by rewrite mulmx1.
  by rewrite [X in _ <= X]mulrAC; apply: ler_wpmul2l => //; apply: mulr_ge0.
rewrite linearN /= mulmxN mulNmx opprK /r.
have := cauchy_schwarz_matrix rho nu^T psd_si; rewrite trmxK => k; apply: loewner_trans k _.
have bound : rho *m si *m rho^T ⪯ kappa^-1 *: (rho *m T^T *m T *m rho^T).
  have -> : kappa^-1 *: (rho *m T^T *m T *m rho^T) = rho *m (kappa^-1 *: (T^T *m T)) *m rho^T by rewrite mulmxZr mulmxZl !mulmxA.
  exact/congruence_mono/(innovation_inverse symV symPt gap eta_row w_trace kappa_gt0).
apply: (@loewner_trans _ _ (tau2 *: (rho *m si *m rho^T))).
  rewrite -scalerBl; apply: psdZ; last exact: psd_congruence.
  by rewrite subr_ge0 /form trmxK.
by rewrite -scalerA; apply: loewnerZ.
Qed.

End Mean.

(** EK-D1: (K − K̃)ᵢⱼ² ≤ (2/κ²)(ρTᵀTρᵀ + w G̃WG̃ᵀ)ᵢᵢ (TᵀT)ⱼⱼ. *)
Theorem enclosed_gain i j : (L - K) i j ^+ 2 <= spread i i * (kappa^-1 * (T^T *m T) j j).
Proof.
pose u : 'rV[R]_p := row i ((K - L) *m Sigma H V P); pose v : 'rV[R]_p := delta_mx 0 j.
have e : (L - K) i j = - form si u v.
  have -> : form si u v = (K - L) i j.
    by rewrite /form trmx_delta -colE mxE -row_mul mulmxK // mxE.
  by rewrite -[L - K]opprB mxE.
rewrite e sqrrN; apply: le_trans (cauchy_schwarz u v psd_si) _; apply: ler_pmul; try exact: psd_si.2.
  have -> : form si u u = form ((K - L) *m Sigma H V P *m (K - L)^T) (delta_mx 0 i) (delta_mx 0 i).
    by rewrite /u rowE -form_congr trmx_mul (pd_sym pdS) mulmxK // !mulmxA.
  by have := loss_of_gain.2 (delta_mx 0 i); rewrite formB subr_ge0 !form_delta.
have := (innovation_inverse symV symPt gap eta_row w_trace kappa_gt0).2 v.
by rewrite formB subr_ge0 formZ !form_delta.
Qed.

End Step.
