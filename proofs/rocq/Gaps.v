(** * How far a matrix is from what was computed

      within W Z   −W ⪯ Z ⪯ W

    What the enclosures of the certified tier rest upon: bounds of a gap Z by a matrix W and of sums and inverses in the
    order of Loewner. Source: EK-L5, EK-L6. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing PositiveSemidefinite.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Definition within (R : realFieldType) n (W Z : 'M[R]_n) := - W ⪯ Z /\ Z ⪯ W.

Section SumsOfSquares.
Variable R : realFieldType.

Lemma form_square n (h x : 'rV[R]_n) : form (h^T *m h) x x = ((x *m h^T) 0 0) ^+ 2.
Proof.
rewrite /form mulmxA -(mulmxA (x *m h^T)) -[h *m x^T]trmxK trmx_mul trmxK.
by rewrite mxE big_ord1 [_^T _ _]mxE expr2.
Qed.

Lemma form_scalar n (c : R) (x y : 'rV[R]_n) : form c%:M x y = c * form 1%:M x y.
Proof. by rewrite -(formZ c) scalemx1. Qed.

Lemma psd_square n (h : 'rV[R]_n) : psd (h^T *m h).
Proof. by have := psd_gram h^T; rewrite trmxK. Qed.

(** Every semidefinite matrix is a sum of squares c hᵀh with c ≥ 0, without roots: what holds of 0 and is kept when a
    square is added holds of all. *)
Theorem psd_ind n (P : 'M[R]_n -> Prop) :
  P 0 -> (forall X (h : 'rV_n) c, psd X -> 0 <= c -> P X -> P (X + c *: (h^T *m h))) -> forall X, psd X -> P X.
Proof.
move=> P0 PS X; move: {2}(\rank X).+1 (ltnSn (\rank X)) => k.
elim: k X => // k IH X rX pX; have sX := psd_sym pX.
have [-> // | nX] := eqVneq X 0.
have [x x0] : exists x, 0 < form X x x.
  have [i ri] : exists i, row i X != 0.
    apply/existsP; rewrite -negb_forall; apply: contra nX => /forallP h.
    by apply/eqP/row_matrixP=> i; rewrite row0; apply/eqP.
  exists (delta_mx 0 i); rewrite lt_def pX.2 andbT; apply: contraNneq ri => /(psd_kernel pX).
  by rewrite -rowE => ->.
set c := form X x x in x0; set h := x *m X; set Y := X - c^-1 *: (h^T *m h).
have hT : h^T = X *m x^T by rewrite trmx_mul sX.
have cE : x *m X *m x^T = c%:M by rewrite [LHS]mx11_scalar.
have pY : psd Y.
  split=> [|y]; first by rewrite trmxD trmxN trmxZ trmx_mul trmxK sX.
  rewrite /Y formB formZ form_square hT mulmxA subr_ge0 mulrC ler_pdivr_mulr //.
  exact: cauchy_schwarz.
have xY : Y *m x^T = 0.
  rewrite mulmxBl mulmxZl -mulmxA /h cE mul_mx_scalar hT scalerA mulVf ?scale1r ?subrr //.
  exact: lt0r_neq0.
have sub : (Y <= X)%MS.
  by apply/submxP; exists (1%:M - c^-1 *: (h^T *m x)); rewrite mulmxBl mul1mx mulmxZl -mulmxA.
have rY : (\rank Y < \rank X)%N.
  rewrite ltn_neqAle mxrankS // andbT; apply: contraTneq x0 => e.
  have /andP[_ XY] : (Y == X)%MS by rewrite -(mxrank_leqif_eq sub) e.
  have /submxP[z hz] : (h <= Y)%MS by apply: submx_trans XY; apply: submxMl.
  by rewrite -leNgt /c /form -/h hz -mulmxA xY mulmx0 mxE.
have -> : X = Y + c^-1 *: (h^T *m h) by rewrite subrK.
apply: PS => //; last by apply: IH => //; apply: leq_trans rY _.
by rewrite invr_ge0 ltW.
Qed.

Lemma trace_square n (h : 'rV[R]_n) (Y : 'M_n) : \tr (h^T *m h *m Y) = form Y h h.
Proof. by rewrite -mulmxA mxtrace_mulC /form trace_mx11. Qed.

(** The trace of a product of semidefinite matrices is no less than 0. *)
Theorem trace_ge0 n (X Y : 'M[R]_n) : psd X -> psd Y -> 0 <= \tr (X *m Y).
Proof.
move=> pX pY; move: X pX; apply: psd_ind => [|X h c _ c0 IH]; first by rewrite mul0mx mxtrace0.
by rewrite mulmxDl mxtraceD mulmxZl mxtraceZ trace_square addr_ge0 // mulr_ge0 // pY.2.
Qed.

(** A semidefinite matrix is at most its trace. *)
Theorem psd_le_trace n (X : 'M[R]_n) : psd X -> X ⪯ (\tr X)%:M.
Proof.
move=> pX; split=> [|x]; first by rewrite trmxD trmxN tr_scalar_mx (psd_sym pX).
have pI : psd ((form 1%:M x x)%:M - x^T *m x).
  split=> [|y]; first by rewrite trmxD trmxN tr_scalar_mx trmx_mul trmxK.
  rewrite formB form_square form_scalar subr_ge0.
  by have := cauchy_schwarz y x (psd1 R n); rewrite {1}/form mulmx1 mulrC.
have := trace_ge0 pI pX.
rewrite mulmxBl mul_scalar_mx mxtraceD mxtraceZ raddfN /= trace_square.
by rewrite formB (form_scalar (\tr X)) mulrC.

Qed.

End SumsOfSquares.

Section Order.
Variables (R : realFieldType) (n : nat).
Implicit Types A B W Z : 'M[R]_n.

Lemma double_inj (A B : 'M[R]_n) : A + A = B + B -> A = B.
Proof.
move=> e; apply/matrixP=> i j; have := congr1 (fun M : 'M_n => M i j) e.
rewrite !entryD -!mulr2n => /eqP; rewrite -subr_eq0 -mulrnBl mulrn_eq0 /= subr_eq0 => /eqP //.
Qed.

Lemma within_sym W Z : within W Z -> Z^T = Z /\ W^T = W.
Proof.
case=> [[h1 _] [h2 _]]; move: h1 h2; rewrite opprK !(trmxD, trmxN) => h1 h2.
split; apply: double_inj.
  have -> : Z^T + Z^T = Z^T + W^T - (W^T - Z^T) by sums.
  by rewrite h1 h2; sums.
have -> : W^T + W^T = Z^T + W^T + (W^T - Z^T) by sums.
by rewrite h1 h2; sums.
Qed.

Lemma within_psd W Z : within W Z -> psd W.
Proof.
move=> h; have [sZ sW] := within_sym h; case: h => [[_ h1] [_ h2]]; split=> // x.
have := addr_ge0 (h1 x) (h2 x); rewrite -formD.
have -> : Z - - W + (W - Z) = 2%:R *: W by sums.
by rewrite formZ pmulr_rge0 ?ltr0n.
Qed.

Lemma withinN W Z : within W Z -> within W (- Z).
Proof.
case=> h1 h2; split; first by have <- : W - Z = - Z - - W by sums.
by have <- : Z - - W = W - - Z by sums.
Qed.

Lemma within_form W Z x : within W Z -> `|form Z x x| <= form W x x.
Proof.
case=> [[_ h1] [_ h2]]; have := h1 x; have := h2 x; rewrite !formB formN subr_ge0 => h.
by rewrite opprK addrC -{1}[form Z x x]opprK subr_ge0 => h'; rewrite ler_norml h andbT ler_oppl.
Qed.

Lemma withinD W W' Z Z' : within W Z -> within W' Z' -> within (W + W') (Z + Z').
Proof.
by case=> a b [c d]; split; [rewrite opprD|]; apply: loewnerD.
Qed.

Lemma within_le W W' Z : within W Z -> W ⪯ W' -> within W' Z.
Proof.
case=> a b c; split; last exact: loewner_trans b c.
by apply: loewner_trans a; have <- : W' - W = - W - - W' by sums.
Qed.

End Order.

Section Gaps.
Variables (R : realFieldType) (n : nat).
Implicit Types W Z X E : 'M[R]_n.

Lemma within_congruence m (C : 'M[R]_(m, n)) W Z : within W Z -> within (C *m W *m C^T) (C *m Z *m C^T).
Proof. by case=> a b; split; [rewrite -mulNmx -mulmxN|]; apply: congruence_mono. Qed.

Lemma form_block m (A : 'M[R]_n) (B : 'M_(n, m)) (C : 'M_(m, n)) (D : 'M_m) a b c d :
  form (block_mx A B C D) (row_mx a b) (row_mx c d) = form A a c + form C b c + (form B a d + form D b d).
Proof. by rewrite /form tr_row_mx mul_row_block mul_row_col !mulmxDl mxE !entryD. Qed.

Lemma form0r m (A : 'M[R]_(m, n)) x : form A x 0 = 0.
Proof. by rewrite /form trmx0 mulmx0 mxE. Qed.

(** EK-L5: −W ⪯ Z ⪯ W bounds every entry of Z: (uᵀZv)² ≤ uᵀWu · vᵀWv. *)
Theorem gap_form W Z (u v : 'rV[R]_n) : within W Z -> form Z u v ^+ 2 <= form W u u * form W v v.
Proof.
move=> h; have [sZ sW] := within_sym h; case: h => [[_ h1] [_ h2]].
have pJ : psd (block_mx W Z Z W).
  split=> [|x]; first by rewrite tr_block_mx sZ sW.
  rewrite -(hsubmxK x) form_block; set a := lsubmx x; set b := rsubmx x.
  have := addr_ge0 (h1 (a + b)) (h2 (a - b)).
  rewrite -[a - b]/(a + - b) -(scaleN1r b) !(formB, formN, formDl, formDr, formZl, formZr).
  rewrite (form_sym b a sZ) (form_sym b a sW) => pos; rewrite -(pmulrn_lge0 _ (ltn0Sn 1)); congr (0 <= _): pos; ring.
have := cauchy_schwarz (row_mx u 0) (row_mx 0 v) pJ.
by rewrite !form_block !(form0l, form0r) !(addr0, add0r).
Qed.

Lemma within_square W Z (h : 'rV[R]_n) : within W Z -> Z *m (h^T *m h) *m Z ⪯ form W h h *: W.
Proof.
move=> gap; have [sZ sW] := within_sym gap.
have e : Z *m (h^T *m h) *m Z = (h *m Z)^T *m (h *m Z) by rewrite trmx_mul sZ !mulmxA.
split=> [|x]; first by rewrite e trmxD trmxN trmxZ sW (trmx_mul (h *m Z)^T) trmxK.
rewrite e formB formZ form_square subr_ge0 trmx_mul sZ mulmxA -[X in X ^+ 2 <= _]/(form Z x h) mulrC.
exact: gap_form.
Qed.

(** EK-L5: ZXZ ⪯ tr(XW) W for X ⪰ 0: the square of a gap is as small as the square of a number. *)
Theorem gap_square W Z X : within W Z -> psd X -> Z *m X *m Z ⪯ \tr (X *m W) *: W.
Proof.
move=> gap pX; move: X pX; apply: psd_ind => [|X h c _ c0 IH].
  by rewrite mulmx0 !mul0mx mxtrace0 scale0r; apply: loewner_refl.
rewrite mulmxDl mulmxDr mulmxDl mxtraceD scalerDl mulmxZl mulmxZr mulmxZl mxtraceZ -scalerA trace_square.
by apply: loewnerD => //; apply: loewnerZ => //; apply: within_square.
Qed.

(** EK-L6: a symmetric matrix of errors |eᵢⱼ| ≤ cᵢⱼsᵢsⱼ is within the diagonal matrix of sᵢ² Σⱼ cᵢⱼ. *)
Theorem rounding E (c : 'M[R]_n) (s : 'I_n -> R) : E^T = E -> c^T = c ->
  (forall i, 0 <= s i) -> (forall i j, 0 <= c i j) -> (forall i j, `|E i j| <= c i j * s i * s j) ->
  within (diag_mx (\row_i (s i ^+ 2 * \sum_j c i j))) E.
Proof.
move=> sE sc s0 c0 bound; set D := diag_mx _.
have formE (M : 'M[R]_n) x : form M x x = \sum_i \sum_j M i j * (x 0 i * x 0 j).
  rewrite /form mxE exchange_big /=; apply: eq_bigr => j _; rewrite !mxE big_distrl /=.
  by apply: eq_bigr => i _; ring.
have formDg x : form D x x = \sum_i \sum_j c i j * (s i * x 0 i) ^+ 2.
  rewrite formE; apply: eq_bigr => i _; rewrite (bigD1 i) //= big1 ?addr0 => [|j ji].
    by rewrite !mxE eqxx mulr1n -[LHS]mulrA mulrCA big_distrl /=; apply: eq_bigr => j _; ring.
  by rewrite !mxE eq_sym (negbTE ji) mulr0n mul0r.
have swap x : form D x x = \sum_i \sum_j c i j * (s j * x 0 j) ^+ 2.
  rewrite formDg exchange_big /=; apply: eq_bigr => i _; apply: eq_bigr => j _.
  by rewrite -[in LHS]sc mxE.
have main x : `|form E x x| <= form D x x.
  apply: (@le_trans _ _ (\sum_i \sum_j `|E i j * (x 0 i * x 0 j)|)).
    rewrite formE; apply: le_trans (ler_norm_sum _ _ _) _.
    by apply: ler_sum => i _; apply: ler_norm_sum.
  rewrite -(ler_pmuln2r (ltn0Sn 1)) [X in _ <= X]mulr2n {1}formDg swap -big_split -sumrMnl /=.
  apply: ler_sum => i _; rewrite -big_split -sumrMnl /=; apply: ler_sum => j _.
  have p : 0 <= c i j * (s i * `|x 0 i| - s j * `|x 0 j|) ^+ 2 by rewrite mulr_ge0 ?sqr_ge0.
  have q : `|E i j| * (`|x 0 i| * `|x 0 j|) <= c i j * s i * s j * (`|x 0 i| * `|x 0 j|).
    by apply: ler_wpmul2r; rewrite ?mulr_ge0.
  rewrite !normrM; apply: (@le_trans _ _ (c i j * s i * s j * (`|x 0 i| * `|x 0 j|) *+ 2)).
    by rewrite ler_muln2r q orbT.
  have sq (y : R) : y ^+ 2 = `|y| ^+ 2 by rewrite real_normK ?num_real.
  rewrite !exprMn (sq (x 0 i)) (sq (x 0 j)) -subr_ge0.
  by congr (0 <= _): p; ring.
have sD : D^T = D by rewrite tr_diag_mx.
by split; split=> [|x]; rewrite ?trmxD ?trmxN ?sD ?sE // formB ?formN subr_ge0;
  have := main x; rewrite ler_norml => /andP[].
Qed.

End Gaps.

Section Sums.
Variables (R : realFieldType) (n p : nat).
Implicit Types (a b : 'M[R]_(n, p)) (S : 'M[R]_p).

(** The inequality behind every sum: (a + b)S(a + b)ᵀ ⪯ (1 + α) aSaᵀ + (1 + 1/α) bSbᵀ. *)
Theorem sum_of_two S a b t : psd S -> 0 < t ->
  (a + b) *m S *m (a + b)^T ⪯ (1 + t) *: (a *m S *m a^T) + (1 + t^-1) *: (b *m S *m b^T).
Proof.
move=> pS t0; have nt := lt0r_neq0 t0.
have -> : (1 + t) *: (a *m S *m a^T) + (1 + t^-1) *: (b *m S *m b^T) - (a + b) *m S *m (a + b)^T
        = t^-1 *: ((t *: a - b) *m S *m (t *: a - b)^T).
  by multiply; entries; field.
by apply: psdZ; [rewrite invr_ge0 ltW | apply: psd_congruence].
Qed.

Theorem difference_of_two S a b : psd S ->
  (a - b) *m S *m (a - b)^T ⪯ 2%:R *: (a *m S *m a^T + b *m S *m b^T).
Proof.
move=> pS; have -> : 2%:R *: (a *m S *m a^T + b *m S *m b^T) - (a - b) *m S *m (a - b)^T
  = (a + b) *m S *m (a + b)^T by expand.
exact: psd_congruence.
Qed.

Theorem sum_of_three S a b c : psd S ->
  (a + b + c) *m S *m (a + b + c)^T ⪯ 3%:R *: (a *m S *m a^T + b *m S *m b^T + c *m S *m c^T).
Proof.
move=> pS; have -> : 3%:R *: (a *m S *m a^T + b *m S *m b^T + c *m S *m c^T) - (a + b + c) *m S *m (a + b + c)^T
  = (a - b) *m S *m (a - b)^T + (a - c) *m S *m (a - c)^T + (b - c) *m S *m (b - c)^T by expand.
by apply: psdD; [apply: psdD|]; apply: psd_congruence.
Qed.

(** The inequality of Cauchy and Schwarz for matrices: (aSv)(aSv)ᵀ ⪯ (vᵀSv) aSaᵀ. *)
Theorem cauchy_schwarz_matrix S a (v : 'rV[R]_p) : psd S ->
  (a *m S *m v^T) *m (a *m S *m v^T)^T ⪯ form S v v *: (a *m S *m a^T).
Proof.
move=> pS; have sS := psd_sym pS.
have e : (a *m S *m v^T) *m (a *m S *m v^T)^T = (v *m S *m a^T)^T *m (v *m S *m a^T).
  by rewrite !tr_mul3 !trmxK sS.
split=> [|x]; first by rewrite e trmxD trmxN trmxZ (tr_congr _ sS) (trmx_mul (v *m S *m a^T)^T) trmxK.
rewrite formB formZ e form_square form_congr subr_ge0 mulrC.
have -> : (x *m (v *m S *m a^T)^T) 0 0 = form S (x *m a) v by rewrite tr_mul3 trmxK sS /form !mulmxA.
exact: cauchy_schwarz.
Qed.

End Sums.
