(** * Contractions and the equation of Stein

      contraction D        some T ⪰ 0 has T − D T Dᵀ ≻ 0: a certificate that D is stable
      stein D1 D2 X        X − D1 X D2ᵀ
      contraction_rate     D T Dᵀ ⪯ r T with r < 1

    For two contractions the equation X − D1 X D2ᵀ = Q has exactly one solution, over any ordered field: the energy
    tr(S₁XS₂Xᵀ) with Sᵢ = Tᵢ⁻¹ falls under X ↦ D1 X D2ᵀ. Over a real closed field R a contraction has all its
    eigenvalues in the open unit disc of R[i]. Source: AK, Lemma 4.2; Stein 1952. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From mathcomp.real_closed Require Import complex.
From Kalman Require Import PositiveSemidefinite PseudoInverse Joint Trace.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Definition contraction (R : realFieldType) n (D : 'M[R]_n) :=
  exists2 T, psd T & pd (T - D *m T *m D^T).

Section Contraction.
Variables (R : realFieldType) (n : nat).
Implicit Types D T S X Q : 'M[R]_n.

Lemma certificate_pd D T : psd T -> pd (T - D *m T *m D^T) -> pd T.
Proof. by move=> pT pTD; rewrite -(subrK (D *m T *m D^T) T); apply/pdD/psd_congruence. Qed.

(** The inverse of a certificate is one of the transpose. *)
Theorem dual_certificate D T : psd T -> pd (T - D *m T *m D^T) ->
  pd (invmx T) /\ pd (invmx T - D^T *m invmx T *m D).
Proof.
move=> psdT pTD; have pT := certificate_pd psdT pTD; have pS := pd_inv pT; split=> //.
have [ST TS] := (mulVmx (pd_unit pT), mulmxV (pd_unit pT)).
move: (invmx T) pS ST TS => S pS ST TS; have sS := pd_sym pS.
split; first by rewrite linearB /= tr_mul3 trmxK sS.
move=> x nx; rewrite formB subr_gt0; pose u := x *m D^T *m S.
have -> : form (D^T *m S *m D) x x = form T u u.
  rewrite -{2}[D]trmxK form_congr /u /form (trmx_mul _ S) sS !mulmxA.
  by rewrite -[_ *m S *m T]mulmxA ST mulmx1.
have q : form T u u = form T (u *m D) (x *m S).
  by rewrite /form /u !trmx_mul trmxK sS !mulmxA -![_ *m T *m S]mulmxA TS !mulmx1.
have Sx : form T (x *m S) (x *m S) = form S x x.
  by rewrite /form trmx_mul sS !mulmxA -[_ *m S *m T]mulmxA ST mulmx1.
have x0 := pS.2 x nx; have := psdT.2 u; rewrite le_eqVlt => /orP[/eqP<- //|u0].
rewrite -(ltr_pmul2l u0); have := cauchy_schwarz (u *m D) (x *m S) psdT.
rewrite -q Sx expr2 => /le_lt_trans; apply; rewrite ltr_pmul2r //.
have nu : u != 0 by apply: contraTneq u0 => ->; rewrite form0l ltxx.
by have := pTD.2 u nu; rewrite formB form_congr subr_gt0.
Qed.

Lemma contraction_tr D : contraction D -> contraction D^T.
Proof.
case=> T pT pTD; have [pS pSD] := dual_certificate pT pTD.
by exists (invmx T); rewrite ?trmxK //; apply: pd_psd.
Qed.

(** A certificate shrinks by a rate: D T Dᵀ ⪯ (1 − e) T. *)
Theorem contraction_rate D T : psd T -> pd (T - D *m T *m D^T) ->
  exists e, [/\ 0 < e, e <= 1 & D *m T *m D^T ⪯ (1 - e) *: T].
Proof.
move=> pT pTD; have [b b1 Tb] := psd_le_pd pT pTD; have b0 : 0 < b by apply: lt_le_trans b1; apply: ltr01.
have bi : 0 < b^-1 by rewrite invr_gt0.
exists b^-1; split; rewrite ?invf_le1 //.
have := psdZ (ltW bi) Tb; rewrite !scalerBr !scalerA mulVf ?gt_eqF // !scale1r.
by rewrite scalerBl scale1r addrAC.
Qed.

(** AK-T2.3-diff: if D1 and D2 are contractions, X = D1 X D2ᵀ only for X = 0. *)
Theorem stein_unique0 D1 D2 X : contraction D1 -> contraction D2 -> X = D1 *m X *m D2^T -> X = 0.
Proof.
case=> T1 pT1 pTD1 [T2 pT2 pTD2] eX.
have [pS1 pSD1] := dual_certificate pT1 pTD1; have [pS2 pSD2] := dual_certificate pT2 pTD2.
move: (invmx T1) (invmx T2) pS1 pSD1 pS2 pSD2 => S1 S2 pS1 pSD1 pS2 pSD2.
set P1 := D1^T *m S1 *m D1 in pSD1; set P2 := D2^T *m S2 *m D2 in pSD2.
have e : \tr (S1 *m (X *m S2 *m X^T)) = \tr (P1 *m (X *m P2 *m X^T)).
  rewrite {1 2}eX tr_mul3 trmxK /P1 /P2 !mulmxA mxtrace_mulC !mulmxA.
  by [].
have pP2 : psd (X *m P2 *m X^T).
  by apply: psd_congruence; apply: psd_congruenceT; apply: pd_psd.
have le1 : \tr (P1 *m (X *m P2 *m X^T)) <= \tr (S1 *m (X *m P2 *m X^T)).
  by have := trace_mul_ge0 (pd_psd pSD1) pP2; rewrite mulmxBl linearB subr_ge0.
have z : X *m (S2 - P2) *m X^T = 0.
  apply: (trace_mul_eq0 pS1); first exact/psd_congruence/pd_psd.
  apply/eqP; rewrite eq_le trace_mul_ge0 ?andbT; [| exact: pd_psd | exact/psd_congruence/pd_psd].
  by rewrite mulmxBr mulmxBl mulmxBr linearB /= subr_le0 e.
apply/row_matrixP=> i; rewrite row0; apply/eqP/negPn/negP => /(pSD2.2).
by rewrite rowE -form_congr z form0 ltxx.
Qed.

(** If D1 and D2 are contractions, X − D1 X D2ᵀ = Q has at most one solution. *)
Theorem stein_unique D1 D2 Q X Y : contraction D1 -> contraction D2 ->
  X = D1 *m X *m D2^T + Q -> Y = D1 *m Y *m D2^T + Q -> X = Y.
Proof.
move=> c1 c2 eX eY; apply/eqP; rewrite -subr_eq0; apply/eqP/(stein_unique0 c1 c2).
by rewrite {1}eX {1}eY opprD addrACA subrr addr0 mulmxBr mulmxBl.
Qed.

(** If D1 and D2 are contractions, X − D1 X D2ᵀ = Q has a solution. *)
Theorem stein_exists D1 D2 Q : contraction D1 -> contraction D2 -> {X | X = D1 *m X *m D2^T + Q}.
Proof.
move=> c1 c2; pose M := 1%:M - lin_mx (mulmx D1) *m lin_mx (mulmxr D2^T).
have eM X : mxvec X *m M = mxvec (X - D1 *m X *m D2^T).
  by rewrite mulmxBr mulmx1 mulmxA !mul_vec_lin linearB.
have uM : M \in unitmx.
  rewrite -row_free_unit; apply/inj_row_free => x; rewrite -(vec_mxK x) eM => h.
  have {}h : vec_mx x - D1 *m vec_mx x *m D2^T = 0 by rewrite -[LHS]mxvecK h linear0.
  by rewrite (stein_unique0 c1 c2 (X := vec_mx x)) ?linear0 //; apply/eqP; rewrite -subr_eq0 h.
exists (vec_mx (mxvec Q *m invmx M)); apply/eqP; rewrite addrC -subr_eq; apply/eqP.
by rewrite -[LHS]mxvecK -eM vec_mxK mulmxKV // mxvecK.
Qed.

(** The solution for a symmetric right side is symmetric. *)
Theorem stein_sym D Q X : contraction D -> Q^T = Q -> X = D *m X *m D^T + Q -> X^T = X.
Proof.
move=> c sQ eX; apply: (stein_unique c c (Q := Q)) => //.
by rewrite {1}eX linearD /= tr_mul3 trmxK sQ.
Qed.

End Contraction.

Fact square_difference (R : realFieldType) (i x y : R) :
  i - x - (x - y) + 4%:R * x = i + x + (x + y).
Proof. by ring. Qed.

Section Powers.
Variables (R : realFieldType) (n : nat).
Implicit Types X : 'M[R]_n.

(** AK-T2.3-diff: X = D1 X D2ᵀ gives X = D1ᵏ X (D2ᵀ)ᵏ for every k. *)
Theorem stein_power (D1 D2 X : 'M[R]_n.+1) k : X = D1 *m X *m D2^T -> X = (D1 ^+ k) *m X *m (D2^T ^+ k).
Proof.
move=> e; elim: k => [|k IH]; first by rewrite !expr0 mul1mx mulmx1.
by rewrite {1}IH {1}e exprSr exprS -!mulmxE !mulmxA.
Qed.

(** A symmetric matrix is below a multiple of a definite one. *)
Lemma sym_le_pd X T : X^T = X -> pd T -> exists2 b, 1 <= b & X ⪯ b *: T.
Proof.
move=> sX pT; have q0 : 0 <= 4%:R^-1 :> R by rewrite invr_ge0 ler0n.
have [b b1 Yb] := psd_le_pd (psdZ q0 (psd_gram (1%:M + X))) pT.
exists b => //; apply: loewner_trans Yb.
have <- : 4%:R^-1 *: ((1%:M - X) *m (1%:M - X)^T) + X = 4%:R^-1 *: ((1%:M + X) *m (1%:M + X)^T).
  apply: (scalerI (a := 4%:R)); rewrite ?pnatr_eq0 // scalerDr !scalerA mulfV ?pnatr_eq0 // !scale1r.
  have -> : (1%:M - X)^T = 1%:M - X by rewrite linearB /= trmx1 sX.
  have -> : (1%:M + X)^T = 1%:M + X by rewrite linearD /= trmx1 sX.
  rewrite mulmxBl mulmxDl !(mulmxBr, mulmxDr) !mulmx1 !mul1mx ?mulmxN.
  move: (X *m X) (1%:M) => Z E; apply/matrixP=> i j; rewrite !mxE; apply: square_difference.
by rewrite addrK; apply: psdZ => //; apply: psd_gram.
Qed.

End Powers.

Section Geometric.
Variable R : archiFieldType.

Lemma bernoulli (e : R) k : 0 < e -> e <= 1 -> (1 - e) ^+ k * (1 + k%:R * e) <= 1.
Proof.
move=> e0 e1; have f0 : 0 <= 1 - e by rewrite subr_ge0.
elim: k => [|k IH]; first by rewrite expr0 mul0r addr0 mulr1.
apply: le_trans IH; rewrite exprSr -mulrA; apply: ler_wpmul2l; first exact: exprn_ge0.
have -> : (1 - e) * (1 + k.+1%:R * e) = (1 + k%:R * e) - e * (k.+1%:R * e) by rewrite mulrS; ring.
by rewrite ler_subl_addr ler_addl !mulr_ge0 ?ler0n ?(ltW e0).
Qed.

(** A number below every c rᵏ with r < 1 is not positive: here the field must be archimedean. *)
Lemma geometric_le0 (f c e : R) : 0 < e -> e <= 1 -> (forall k, f <= c * (1 - e) ^+ k) -> f <= 0.
Proof.
move=> e0 e1 h; rewrite leNgt; apply/negP => f0.
have c0 : 0 <= c by have := h 0%N; rewrite expr0 mulr1 => /(le_trans (ltW f0)).
have b k : f * (1 + k%:R * e) <= c.
  have k0 : 0 <= 1 + k%:R * e by rewrite addr_ge0 ?ler01 // mulr_ge0 ?ler0n ?(ltW e0).
  apply: le_trans (ler_wpmul2r k0 (h k)) _; rewrite -mulrA -[X in _ <= X]mulr1.
  exact/ler_wpmul2l/bernoulli.
have fe0 : 0 < f * e by rewrite mulr_gt0.
have q0 : 0 <= c / (f * e) by rewrite divr_ge0 // ltW.
have := archi_boundP q0; rewrite ltr_pdivr_mulr // => lt.
have := le_lt_trans (b (Num.bound (c / (f * e)))) lt.
by rewrite mulrDr mulr1 mulrCA gtr_addr ltNge ltW.
Qed.

(** The solution of X − DXDᵀ = Q is semidefinite if Q is. *)
Theorem stein_psd n (D Q X : 'M[R]_n) : contraction D -> psd Q -> X = D *m X *m D^T + Q -> psd X.
Proof.
move=> cD pQ eX; have sX := stein_sym cD (psd_sym pQ) eX; split=> // x.
case: cD => T pT pTD; have [e [e0 e1 rate]] := contraction_rate pT pTD.
have r0 : 0 <= 1 - e by rewrite subr_ge0.
have sNX : (- X)^T = - X by rewrite linearN /= sX.
have [b b1 Xb] := sym_le_pd sNX (certificate_pd pT pTD).
have b0 : 0 <= b by apply: le_trans b1; apply: ler01.
have low k : - X ⪯ (b * (1 - e) ^+ k) *: T.
  elim: k => [|k IH]; first by rewrite expr0 mulr1.
  apply: loewner_trans (_ : - X ⪯ - (D *m X *m D^T)) _.
    by rewrite opprK addrC {1}eX addrC addKr.
  apply: loewner_trans (_ : _ ⪯ (b * (1 - e) ^+ k) *: (D *m T *m D^T)) _.
    by have := congruence_mono D IH; rewrite mulmxN mulNmx -scalemxAr -scalemxAl.
  by rewrite exprSr mulrA -[_ *: T]scalerA; apply: loewnerZ => //; rewrite mulr_ge0 ?exprn_ge0.
rewrite -oppr_le0 -formN; apply: (geometric_le0 (c := b * form T x x) e0 e1) => k.
by have := (low k).2 x; rewrite formB subr_ge0 formZ mulrAC.
Qed.

End Geometric.

Lemma char_poly_tr (F : fieldType) n (A : 'M[F]_n) : char_poly A^T = char_poly A.
Proof. by rewrite /char_poly /char_poly_mx -map_trmx -{1}(tr_scalar_mx _ 'X) -linearB det_tr. Qed.

(** XY and YX have the same eigenvalues besides 0. *)
Lemma eigenvalue_mulC (F : fieldType) n (X Y : 'M[F]_n) z : z != 0 -> eigenvalue (X *m Y) z -> eigenvalue (Y *m X) z.
Proof.
move=> nz /eigenvalueP[x ex nx]; apply/eigenvalueP; exists (x *m X).
  by rewrite mulmxA -(mulmxA x) ex -scalemxAl.
apply: contraNneq nx => xX; move/eqP: ex; rewrite mulmxA xX mul0mx eq_sym scaler_eq0 (negPf nz).
by move=> /eqP ->.
Qed.

(** Modes that are not observed stay as they are: N has full column rank, AN = NΛ and HN = 0. *)
Lemma unobservable_eigenvalue (F : fieldType) n p r (A : 'M[F]_n) (H : 'M[F]_(p, n)) (N : 'M[F]_(n, r)) L K z :
  row_free N^T -> A *m N = N *m L -> H *m N = 0 ->
  root (char_poly L) z -> root (char_poly (A - K *m H)) z.
Proof.
move=> fN AN HN; rewrite -char_poly_tr -[X in _ -> root X z]char_poly_tr -!eigenvalue_root_char.
move=> /eigenvalueP[x ex nx]; apply/eigenvalueP; exists (x *m N^T).
  by rewrite -mulmxA -trmx_mul mulmxBl -mulmxA HN mulmx0 subr0 AN [(N *m L)^T]trmx_mul mulmxA ex scalemxAl.
by apply: contraNneq nx => xN; apply/eqP/(row_free_inj fN); rewrite xN mul0mx.
Qed.

(** The eigenvector, in its real and imaginary parts u and v: xDᵀ = (a + ib)x with the row x = u + iv. *)
Section Eigenvector.
Variables (R : realFieldType) (n : nat).

(** AK-L4.2-eigen: x*(F − DᵀFD)x = (1 − |λ|²)x*Fx, with real and imaginary parts of x and λ written out. *)
Theorem eigenvector_decides (F D : 'M[R]_n) (u v : 'rV_n) (a b : R) : F^T = F ->
  u *m D^T = a *: u - b *: v -> v *m D^T = a *: v + b *: u ->
  form (F - D^T *m F *m D) u u + form (F - D^T *m F *m D) v v =
  (1 - (a ^+ 2 + b ^+ 2)) * (form F u u + form F v v).
Proof.
move=> sF eu ev; rewrite !formB -{2 4}[D]trmxK !form_congr eu ev -scaleNr.
rewrite !(formDl, formDr, formZl, formZr) (form_sym v u sF).
by move: (form F u u) (form F u v) (form F v v) => p q r; ring.
Qed.

End Eigenvector.

Section Disc.
Variables (R : rcfType) (n : nat).
Local Open Scope complex_scope.

Lemma eigenvector_parts (D : 'M[R]_n) (z : R[i]) (x : 'rV[R[i]]_n) :
  x *m map_mx (real_complex R) D = z *: x ->
  let u := map_mx (@complex.Re R) x in let v := map_mx (@complex.Im R) x in
  u *m D = complex.Re z *: u - complex.Im z *: v /\ v *m D = complex.Re z *: v + complex.Im z *: u.
Proof.
move=> e u v; have h j := congr1 (fun y : 'rV_n => y 0 j) e.
split; apply/rowP=> j; have := h j; rewrite !mxE.
  move=> /(congr1 (@complex.Re R)); rewrite raddf_sum /=.
  case: (z) => a b /=; case: (x 0 j) => c d /= <-.
  by apply: eq_bigr => k _; rewrite !mxE; case: (x 0 k) => ? ? /=; rewrite mulr0 subr0.
move=> /(congr1 (@complex.Im R)); rewrite raddf_sum /=.
case: (z) => a b /=; case: (x 0 j) => c d /= <-.
by apply: eq_bigr => k _; rewrite !mxE; case: (x 0 k) => ? ? /=; rewrite mulr0 add0r.
Qed.

(** AK-L4.2: F ⪰ 0 and F − DᵀFD ≻ 0 put every eigenvalue of D, in the complex numbers R[i], inside the unit circle. *)
Theorem stein_lemma (F D : 'M[R]_n) : psd F -> pd (F - D^T *m F *m D) ->
  forall z : R[i], root (char_poly (map_mx (real_complex R) D)) z -> `|z| < 1.
Proof.
move=> pF pFD z; rewrite -char_poly_tr -eigenvalue_root_char map_trmx => /eigenvalueP[x ex nx].
have /= [eu ev] := eigenvector_parts ex.
set u := map_mx _ x in eu ev; set v := map_mx _ x in eu ev.
have := eigenvector_decides (psd_sym pF) eu ev.
set q := form _ u u + form _ v v => e.
have q0 : 0 < q.
  have [u0|nu] := eqVneq u 0; last by rewrite ltr_paddr ?pFD.2 ?(pd_psd pFD).2.
  have [v0|nv] := eqVneq v 0; last by rewrite ltr_paddl ?pFD.2 ?(pd_psd pFD).2.
  case/eqP: nx; apply/rowP=> j; have := congr1 (fun y : 'rV_n => y 0 j) u0; have := congr1 (fun y : 'rV_n => y 0 j) v0.
  by rewrite !mxE; case: (x 0 j) => c d /= -> ->.
have f0 : 0 <= form F u u + form F v v by rewrite addr_ge0 ?pF.2.
have l1 : complex.Re z ^+ 2 + complex.Im z ^+ 2 < 1.
  rewrite ltNge -subr_le0; apply/negP => l; move: q0; rewrite e ltNge => /negP; apply.
  exact: mulr_le0_ge0.
rewrite normc_def [X in _ < X](_ : 1 = 1%:C) // ltcR.
by rewrite -(sqrtr1 R) ltr_sqrt ?ltr01.
Qed.

(** A contraction has all its eigenvalues inside the unit circle. *)
Theorem contraction_eigenvalues (D : 'M[R]_n) : contraction D ->
  forall z : R[i], root (char_poly (map_mx (real_complex R) D)) z -> `|z| < 1.
Proof.
case=> T pT pTD z; rewrite -char_poly_tr map_trmx; apply: (stein_lemma pT).
by rewrite trmxK.
Qed.

(** EK-T7a: AN = NΛ, HN = 0 with N of full column rank make every eigenvalue of Λ one of A − KH, whatever K, hence ρ(A − KH) ≥ ρ(Λ). *)
Theorem unobservable_modes p r (A : 'M[R]_n) (H : 'M[R]_(p, n)) (N : 'M[R]_(n, r)) L K (z : R[i]) :
  row_free N^T -> A *m N = N *m L -> H *m N = 0 ->
  root (char_poly (map_mx (real_complex R) L)) z ->
  root (char_poly (map_mx (real_complex R) (A - K *m H))) z.
Proof.
move=> fN AN HN rz; rewrite map_mxB map_mxM.
apply: (unobservable_eigenvalue (N := map_mx (real_complex R) N) _ _ _ _ rz).
- by rewrite map_trmx row_free_map.
- by rewrite -!map_mxM AN.
by rewrite -map_mxM HN map_mx0.
Qed.

End Disc.
