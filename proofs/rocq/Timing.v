(** * One timing from the other

    x₊ = A x + D w, y = C x + F w (departing), or y = C x₊ + F w (arriving). Source: HV-X.ad, HV-X.da, CKS-T.stack. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing PositiveSemidefinite PseudoInverse Joint Riccati.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import Order.Theory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Timing.
Variables (R : realFieldType) (n p q : nat).
Variables (A : 'M[R]_n) (C : 'M[R]_(p, n)) (D : 'M[R]_(n, q)) (F : 'M[R]_(p, q)).
Variables (x b : 'cV[R]_n) (w : 'cV[R]_q) (g : 'cV[R]_p).

(** CKS-T.stack: the next state and its observation as an affine image of state and noise. *)
Theorem stacked :
  let x' := A *m x + b + D *m w in
  col_mx x' (C *m x' + g + F *m w) =
  block_mx A D (C *m A) (C *m D + F) *m col_mx x w + col_mx b (C *m b + g).
Proof.
rewrite /= mul_block_col add_col_mx; congr col_mx; first by sums.
by expand.
Qed.

(** HV-X.ad: an observation that arrives is one that departs, with CA for C and CD + F for F. *)
Theorem arriving_departs :
  C *m (A *m x + b + D *m w) + g + F *m w = C *m A *m x + C *m b + g + (C *m D + F) *m w.
Proof. by expand. Qed.

Let L := D *m F^†.

(** HV-X.da: L = DF⁺ = DFᵀ(FFᵀ)⁺. *)
Theorem feedback_gain : (F *m F^T)^† = F^†^T *m F^† /\ L = D *m F^T *m (F *m F^T)^†.
Proof.
have [e1 e2 e3 e4] := pseudo_inverseP F.
have t1 : F^T *m F^†^T = F^† *m F by rewrite -trmx_mul e4.
have t2 : F^†^T *m F^T = F *m F^† by rewrite -trmx_mul e3.
have h : (F *m F^T)^† = F^†^T *m F^†.
  have a : F *m F^T *m (F^†^T *m F^†) = F *m F^†.
    by rewrite mulmxA -(mulmxA F) t1 mulmxA e1.
  have c : F^†^T *m F^† *m (F *m F^T) = F *m F^†.
    by rewrite !mulmxA -(mulmxA _ F^† F) -t1 mulmxA t2 -mulmxA t2 mulmxA e1.
  apply: pseudo_inverse_eq; split; rewrite ?a ?c ?e3 //; first by rewrite mulmxA e1.
  by rewrite mulmxA -t2 -[F^†^T *m F^T *m _]mulmxA t1 -!mulmxA (mulmxA F^†) e2.
split=> //; rewrite h /L -(mulmxA D) (mulmxA F^T) t1 e2 //.
Qed.

(** HV-X.da: the equation of the state, with the observation fed back. *)
Theorem departing_arrives :
  let y := C *m x + g + F *m w in
  A *m x + b + D *m w = (A - L *m C) *m x + b + L *m (y - g) + D *m (1%:M - F^† *m F) *m w.
Proof. by rewrite /= /L; expand. Qed.

(** HV-X.da: the rest of the noise is uncorrelated with F w. *)
Theorem rest_uncorrelated : D *m (1%:M - F^† *m F) *m F^T = 0.
Proof.
have [e1 _ _ e4] := pseudo_inverseP F.
by rewrite -mulmxA mulmxBl mul1mx -e4 -trmx_mul mulmxA e1 subrr mulmx0.
Qed.

(** HV-X.da: and has the covariance DDᵀ − L(DFᵀ)ᵀ. *)
Theorem rest_covariance :
  D *m (1%:M - F^† *m F) *m (D *m (1%:M - F^† *m F))^T = D *m D^T - L *m (D *m F^T)^T.
Proof.
have [_ e2 _ e4] := pseudo_inverseP F; set N := 1%:M - F^† *m F.
have sN : N^T = N by rewrite /N trmxD trmxN trmx1 e4.
have idem : N *m N = N.
  by rewrite /N mulmxBr mulmx1 !mulmxBl mul1mx (mulmxA (F^† *m F)) e2 subrr subr0.
by rewrite trmx_mul sN mulmxA -(mulmxA D) idem /N /L; expand.
Qed.

End Timing.
