(** * Controls: hypotheses that are needed, and that can be met

    Each is a small example. Where one shows that a hypothesis cannot be dropped, the theorem without it would be false;
    where one shows that hypotheses can be met, the theorem is not empty. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint Riccati ParallelSum Trace Stein FixedPoint.
From Kalman Require Import UncorrelatedNoise RandomRiccati.
From Kalman Require Gaps Enclosure.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Scalars.
Variables (R : realFieldType) (n : nat).
Implicit Types a b s v w : R.

Lemma scalarD a b : (a + b)%:M = a%:M + b%:M :> 'M[R]_n. Proof. exact: raddfD. Qed.
Lemma scalarB a b : (a - b)%:M = a%:M - b%:M :> 'M[R]_n. Proof. exact: raddfB. Qed.
Lemma scalar0 : 0%:M = 0 :> 'M[R]_n. Proof. exact: raddf0. Qed.

Lemma scalar_pseudo_inverse a : (a%:M : 'M[R]_n)^† = (a^-1)%:M.
Proof.
apply: pseudo_inverse_eq; have [->|na] := eqVneq a 0.
  by rewrite invr0 scalar0; apply: pseudo_inverse0.
by split; rewrite -!scalar_mxM ?tr_scalar_mx ?mulfV ?mulVf ?mul1r.
Qed.

Lemma scalar_psd a : 0 <= a -> psd (a%:M : 'M[R]_n).
Proof. by move=> a0; rewrite -scalemx1; apply: psdZ => //; apply: psd1. Qed.

Lemma scalar_pd a : 0 < a -> pd (a%:M : 'M[R]_n).
Proof. by move=> a0; rewrite -scalemx1; apply: pdZ => //; apply: pd1. Qed.

Lemma scalar_parallel_sum s w : (s%:M : 'M[R]_n) ∥ w%:M = (s / (s + w) * w)%:M.
Proof. by rewrite /parallel_sum -scalarD scalar_pseudo_inverse -!scalar_mxM. Qed.

Lemma scalar_anderson a v w s :
  anderson (a%:M : 'M[R]_n) v%:M w%:M s%:M = (a * (s / (s + w) * w) * a + v)%:M.
Proof. by rewrite /anderson scalar_parallel_sum tr_scalar_mx -!scalar_mxM scalarD. Qed.

End Scalars.

Section Controls.
Variable R : realFieldType.

(** Control: V ≻ 0 is needed for one fixed point: A = 2, V = 0, W = 1 has the fixed points 0 and 3. *)
Theorem control_two_fixed_points :
  let phi := anderson (2%:R%:M : 'M[R]_1) 0%:M 1%:M in
  [/\ psd (0%:M : 'M[R]_1), psd (3%:R%:M : 'M[R]_1), phi 0%:M = 0%:M, phi 3%:R%:M = 3%:R%:M &
      (0%:M : 'M[R]_1) <> 3%:R%:M].
Proof.
have n4 : 3%:R + 1 != 0 :> R by rewrite -(natrD R 3 1) pnatr_eq0.
split=> /=; rewrite ?scalar_anderson; [by apply: scalar_psd | by apply: scalar_psd; rewrite ler0n | | |].
- by rewrite !(mul0r, mulr0, addr0).
- by congr _%:M; rewrite mulr1 addr0; field.
by move/matrixP/(_ 0 0)/eqP; rewrite !mxE /= !mulr1n eq_sym pnatr_eq0.
Qed.

(** Control: the hypotheses of Theorem 2.3 and of the certificates can be met: A = 1, V = 1/2, W = 1 has T = 1. *)
Theorem control_fixed_point :
  let phi := anderson (1%:M : 'M[R]_1) (2%:R^-1)%:M 1%:M in
  [/\ pd ((2%:R^-1)%:M : 'M[R]_1), psd (1%:M : 'M[R]_1) & phi 1%:M = 1%:M].
Proof.
split=> /=; [by apply: scalar_pd; rewrite invr_gt0 ltr0n | exact: psd1 |].
rewrite scalar_anderson; by congr _%:M; field.
Qed.

(** Control: the joint covariance must be semidefinite: Pxx = Pyy = 0, Pxy = 1 has Pxy Pyy⁺ Pyy = 0. *)
Theorem control_indefinite_joint : let J : 'M[R]_(1 + 1) := block_mx 0 1%:M 1%:M 0 in
  Jxy J *m (Jyy J)^† *m Jyy J <> Jxy J.
Proof.
rewrite /= /Jxy /Jyy block_mxKur block_mxKdr mulmx0 => /matrixP/(_ 0 0)/eqP.
by rewrite !mxE /= eq_sym oner_eq0.
Qed.

(** Control: F, G ⪰ 0 are needed: −1 and 2 have the parallel sum −2, and 1 and −1 break F:G = F − F(F + G)⁺F. *)
Theorem control_indefinite_parallel_sum :
  ((-1)%:M : 'M[R]_1) ∥ 2%:R%:M = (- 2%:R)%:M /\
  (1%:M : 'M[R]_1) ∥ (-1)%:M <> 1%:M - 1%:M *m (1%:M + (-1)%:M)^† *m 1%:M.
Proof.
split; first by rewrite scalar_parallel_sum (_ : -1 + 2%:R = 1) ?divr1 ?mulN1r // addrC addrK.
rewrite scalar_parallel_sum -scalarD scalar_pseudo_inverse subrr invr0 -!scalar_mxM -scalarB.
rewrite !(mulr0, mul0r) subr0 => /matrixP/(_ 0 0)/eqP.
by rewrite !mxE /= !mulr1n eq_sym oner_eq0.
Qed.

(** Control: the certificate of Stein must be strict: D = 1, T = 1 has T − DTDᵀ = 0, and X = DXDᵀ for X = 1. *)
Theorem control_strict_certificate : let D : 'M[R]_1 := 1%:M in
  [/\ psd (1%:M - D *m 1%:M *m D^T), 1%:M = D *m 1%:M *m D^T & (1%:M : 'M[R]_1) <> 0].
Proof.
rewrite /= trmx1 !mulmx1; split=> //; first by rewrite subrr; apply: psd0.
by move/matrixP/(_ 0 0)/eqP; rewrite !mxE /= oner_eq0.
Qed.

(** Control: it must be semidefinite: D = 2, F = −1 has F − DᵀFD = 3. *)
Theorem control_negative_certificate : let D : 'M[R]_1 := 2%:R%:M in
  pd ((-1)%:M - D^T *m (-1)%:M *m D).
Proof.
rewrite /= tr_scalar_mx -!scalar_mxM -scalarB; apply: scalar_pd.
by rewrite mulrN1 mulNr opprK -natrM addrC subr_gt0 (ltr_nat _ 1).
Qed.

(** Control: contractions there are: 1/2, by the certificate 1. *)
Theorem control_contraction : contraction ((2%:R^-1)%:M : 'M[R]_1).
Proof.
exists 1%:M; first exact: psd1.
rewrite tr_scalar_mx -!scalar_mxM -scalarB; apply: scalar_pd.
by rewrite mulr1 subr_gt0 -invfM invf_lt1 ?mulr_gt0 ?ltr0n // -natrM (ltr_nat _ 1).
Qed.

(** Control: PXP = P alone does not determine the pseudo-inverse: P = diag(1, 0) and X = [[1, 1], [1, 5]]. *)
Theorem control_one_penrose_equation :
  let P : 'M[R]_(1 + 1) := block_mx 1%:M 0 0 0 in
  let X : 'M[R]_(1 + 1) := block_mx 1%:M 1%:M 1%:M 5%:R%:M in
  P *m X *m P = P /\ X <> P^†.
Proof.
split=> /=; first by rewrite !mulmx_block !(mulmx0, mul0mx, mulmx1, mul1mx, addr0).
rewrite (pseudo_inverse_eq (X := block_mx 1%:M 0 0 0)); last first.
  by split; rewrite ?mulmx_block ?tr_block_mx ?trmx1 ?trmx0 !(mulmx0, mul0mx, mulmx1, mul1mx, addr0)
    ?mulmx_block ?tr_block_mx ?trmx1 ?trmx0 ?(mulmx0, mul0mx, mulmx1, mul1mx, addr0).
move/(congr1 ursubmx); rewrite !block_mxKur => /matrixP/(_ 0 0)/eqP.
by rewrite !mxE /= oner_eq0.
Qed.

(** Control: Lemma 2.2 of WG needs Q̄ ≻ 0: F = 1, H = 0, Q = 0 has P₊ = P, Q̄ = 0 and the closed loop 1. *)
Theorem control_no_load P :
  let F : 'M[R]_1 := 1%:M in let H : 'M[R]_1 := 0 in
  [/\ filter_step F H 0 1%:M P = P, filter_load F H 0 1%:M P = 0 & filter_loop F H 1%:M P = 1%:M].
Proof.
split=> /=.
- by rewrite filter_stepE trmx0 trmx1 !(mulmx0, mul0mx) subr0 addr0 mul1mx mulmx1.
- by rewrite /filter_load /filter_gain trmx0 !(mulmx0, mul0mx) addr0.
by rewrite /filter_loop mulmx0 subr0 mulmx1.
Qed.

(** AK-Ex4: A = 2I, V = diag(0, 1), W = diag(1, 0): V and V + 3W both are fixed points, V ≻ 0 does not hold. *)
Theorem two_fixed_points_of_order_two :
  let A : 'M[R]_(1 + 1) := 2%:R%:M in
  let V : 'M[R]_(1 + 1) := block_mx 0 0 0 1%:M in
  let W : 'M[R]_(1 + 1) := block_mx 1%:M 0 0 0 in
  [/\ anderson A V W V = V, anderson A V W (V + 3%:R *: W) = V + 3%:R *: W & V + 3%:R *: W <> V].
Proof.
move=> A V W; have tV s : V + s *: W = block_mx s%:M 0 0 1%:M.
  by rewrite scale_block_mx !scaler0 add_block_mx !addr0 add0r scalemx1.
have fix2 s : s != -1 -> anderson A V W (V + s *: W) = V + (2%:R * (s / (s + 1)) * 2%:R) *: W.
  move=> ns; rewrite !tV /anderson /parallel_sum add_block_mx !addr0 -scalarD.
  have n1 : s + 1 != 0 by rewrite addr_eq0.
  rewrite (pseudo_inverse_eq (X := block_mx (s + 1)^-1%:M 0 0 1%:M)).
    rewrite !mulmx_block !(mulmx0, mul0mx, mulmx1, mul1mx, addr0, add0r) -scalar_mxM.
    rewrite (_ : A = block_mx 2%:R%:M 0 0 2%:R%:M) ?tr_block_mx ?trmx0 ?tr_scalar_mx; last exact: scalar_mx_block.
    rewrite !mulmx_block !(mulmx0, mul0mx, mulmx1, mul1mx, addr0, add0r) -!scalar_mxM.
    by rewrite add_block_mx !(addr0, add0r).
  by split; rewrite !mulmx_block ?tr_block_mx !(mulmx0, mul0mx, mulmx1, mul1mx, addr0, add0r) -!scalar_mxM
    ?trmx0 ?tr_scalar_mx ?mulfV ?mulVf ?mul1r.
split.
- have := fix2 0; rewrite !(mul0r, mulr0) !scale0r !addr0; apply.
  by rewrite eq_sym oppr_eq0 oner_eq0.
- rewrite fix2; last by rewrite -subr_eq0 opprK -(natrD R 3 1) pnatr_eq0.
  have n4 : 3%:R + 1 != 0 :> R by rewrite -(natrD R 3 1) pnatr_eq0.
  by congr (_ + _ *: _); field.
rewrite tV => /(congr1 ulsubmx); rewrite !block_mxKul => /matrixP/(_ 0 0)/eqP.
by rewrite !mxE /= mulr1n pnatr_eq0.
Qed.

End Controls.

Section Certificates.
Variable R : realFieldType.
Let half : R := 2%:R^-1.
(** Control: the hypotheses of a certificate of a steady state can be met. *)
Theorem control_steady_certificate :
  let A : 'M[R]_1 := 1%:M in let Q : 'M[R]_1 := (half * half)%:M in let h : 'M[R]_1 := half%:M in
  let C := Enclosure.closed A 1%:M h in
  let rho := h *m Enclosure.Sigma 1%:M h h - Enclosure.Gamma A 1%:M 0 h in
  [/\ forall i, \sum_j `|(1%:M *m Enclosure.Sigma 1%:M h h *m (1%:M : 'M[R]_1)^T - 1%:M) i j| <= 0,
      \tr (1%:M *m (1%:M *m h *m (1%:M : 'M[R]_1)^T) *m (1%:M : 'M[R]_1)^T) <= half,
      0 < 1 - 0 - half &
      Gaps.within (h - ((1 + 2%:R * half / (1 - 0 - half)) *: (C *m h *m C^T)
                   + (2%:R / (1 - 0 - half)) *: (rho *m (1%:M : 'M[R]_1)^T *m 1%:M *m rho^T)))
        (Enclosure.joseph A 1%:M Q 0 h h h - h)].
Proof.
have two : 2%:R != 0 :> R by rewrite pnatr_eq0.
have hh : half + half = 1 by rewrite /half; field.
have h0 : 0 < half by rewrite invr_gt0 ltr0n.
have e1 : 1 - 0 - half = half by rewrite subr0 -hh addrK.
move=> A Q h C rho.
have eS : Enclosure.Sigma 1%:M h h = 1%:M by rewrite /Enclosure.Sigma trmx1 mulmx1 mul1mx /h -scalarD hh.
have eG : Enclosure.Gamma A 1%:M 0 h = h by rewrite /Enclosure.Gamma /A trmx1 !mulmx1 mul1mx addr0.
have er : rho = 0 by rewrite /rho eS eG mulmx1 subrr.
have eC : C = h by rewrite /C /Enclosure.closed /A mulmx1 /h -scalarB -hh addrK.
have eJ : Enclosure.joseph A 1%:M Q 0 h h h = h.
  rewrite /Enclosure.joseph -/C eC /Enclosure.noise trmx0 mul0mx mulmx0 !subr0 /Q /h tr_scalar_mx -!scalar_mxM -!scalarD.
  by congr (_%:M); rewrite /half; field.
split.
- by move=> i; rewrite eS trmx1 !mulmx1 subrr big1 // => j _; rewrite mxE normr0.
- by rewrite trmx1 !mulmx1 !mul1mx mxtrace_scalar.
- by rewrite e1.
rewrite e1 er !mul0mx scaler0 addr0 eC eJ subrr.
have p : psd (h - (1 + 2%:R * half / half) *: (h *m h *m h^T)).
  rewrite /h tr_scalar_mx -!scalar_mxM scale_scalar_mx -scalarB; apply: scalar_psd.
  have -> : half - (1 + 2%:R * half / half) * (half * half * half) = half * half * half.
    by rewrite /half; field.
  by rewrite !mulr_ge0 // ltW.
by split; rewrite ?sub0r ?opprK // subr0.
Qed.
End Certificates.
