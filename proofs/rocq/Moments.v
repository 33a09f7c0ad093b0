(** * The moments of residuals know the noises

    y(k) = x(k) + w(k), x(k+1) = A x(k) + v(k), with uncorrelated noises of covariances V and W.

      residual_1 A V W   V + W + AWAᵀ, the covariance B(1) of y(k) − A y(k−1) = v + w − A w′
      residual_2 A V W   V + W + AVAᵀ + A²W(A²)ᵀ, the covariance B(2) of y(k) − A² y(k−2) = v + A v′ + w − A² w′
      noise_W, noise_V   what is recovered from A, B(1) and B(2)

    Over any field in which 2 is not 0; covariances of any sign. Source: AK, pages 2066 to 2067. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Kalman Require Import MatrixRing.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import GRing.Theory.
Local Open Scope ring_scope.

Section Moments.
Variables (F : fieldType) (n : nat).
Implicit Types (A V W B : 'M[F]_n).

Definition residual_1 A V W := V + W + A *m W *m A^T.
Definition residual_2 A V W := V + W + A *m V *m A^T + A *m A *m W *m (A *m A)^T.
Definition noise_W A B1 B2 := 2%:R^-1 *: (B1 + invmx A *m (B1 - B2) *m (invmx A)^T).
Definition noise_V A B1 B2 := B1 - noise_W A B1 B2 - A *m noise_W A B1 B2 *m A^T.

(** AK-B.1: B(1) is the covariance of v + w − A w′, for noises of covariance diag(V, W, W). *)
Theorem residual_1_covariance A V W :
  row_mx (1%:M : 'M[F]_n) (row_mx (1%:M : 'M[F]_n) (- A))
    *m block_mx V 0 0 (block_mx W 0 0 W)
    *m (row_mx (1%:M : 'M[F]_n) (row_mx (1%:M : 'M[F]_n) (- A)))^T = residual_1 A V W.
Proof.
rewrite !tr_row_mx !mul_row_block !mul_row_col !(mulmx0, mul0mx, add0r, addr0, mul_row_block, mul_row_col).
by rewrite /residual_1; expand.
Qed.

(** AK-B.2: B(2) is the covariance of v + A v′ + w − A² w′, for noises of covariance diag(V, V, W, W). *)
Theorem residual_2_covariance A V W :
  row_mx (row_mx (1%:M : 'M[F]_n) A) (row_mx (1%:M : 'M[F]_n) (- (A *m A)))
    *m block_mx (block_mx V 0 0 V) 0 0 (block_mx W 0 0 W)
    *m (row_mx (row_mx (1%:M : 'M[F]_n) A) (row_mx (1%:M : 'M[F]_n) (- (A *m A))))^T = residual_2 A V W.
Proof.
rewrite !tr_row_mx !mul_row_block !mul_row_col !(mulmx0, mul0mx, add0r, addr0, mul_row_block, mul_row_col).
by rewrite /residual_2; expand.
Qed.

Section Recovery.
Variable A : 'M[F]_n.
Hypotheses (regular : A \in unitmx) (two : 2%:R != 0 :> F).

Let cancel X : invmx A *m (A *m X *m A^T) *m (invmx A)^T = X.
Proof.
rewrite !mulmxA mulVmx // mul1mx -mulmxA trmx_inv mulmxV ?mulmx1 //.
by rewrite unitmx_tr.
Qed.

Let insert X : A *m (invmx A *m X *m (invmx A)^T) *m A^T = X.
Proof.
rewrite !mulmxA mulmxV // mul1mx -mulmxA trmx_inv mulVmx ?mulmx1 //.
by rewrite unitmx_tr.
Qed.

Let halve X : 2%:R^-1 *: (X + X) = X :> 'M[F]_n.
Proof. by entries; field. Qed.

(** AK-B.W: W is recovered from B(1) and B(2), for every invertible A. *)
Theorem recover_W V W : noise_W A (residual_1 A V W) (residual_2 A V W) = W.
Proof.
rewrite /noise_W; have -> : residual_1 A V W - residual_2 A V W = A *m (W - V - A *m W *m A^T) *m A^T.
  by rewrite /residual_1 /residual_2; expand.
rewrite cancel; have -> : residual_1 A V W + (W - V - A *m W *m A^T) = W + W by rewrite /residual_1; expand.
exact: halve.
Qed.

(** AK-B.V: and V is recovered with it. *)
Theorem recover_V V W : noise_V A (residual_1 A V W) (residual_2 A V W) = V.
Proof. by rewrite /noise_V recover_W /residual_1; expand. Qed.

(** AK-B.V: any B(1) is that of the noises that are recovered. *)
Theorem recovered_1 B1 B2 : residual_1 A (noise_V A B1 B2) (noise_W A B1 B2) = B1.
Proof. by rewrite /residual_1 /noise_V; sums. Qed.

(** AK-B.W: and so is any B(2): the map from (V, W) to (B(1), B(2)) is one to one and onto. *)
Theorem recovered_2 B1 B2 : residual_2 A (noise_V A B1 B2) (noise_W A B1 B2) = B2.
Proof.
have e : A *m (noise_W A B1 B2 + noise_W A B1 B2) *m A^T = A *m B1 *m A^T + (B1 - B2).
  have -> : noise_W A B1 B2 + noise_W A B1 B2 = B1 + invmx A *m (B1 - B2) *m (invmx A)^T.
    by rewrite /noise_W; entries; field.
  by rewrite mulmxDr mulmxDl insert.
rewrite /residual_2 /noise_V; set W := noise_W A B1 B2 in e *.
have -> : B1 - W - A *m W *m A^T + W + A *m (B1 - W - A *m W *m A^T) *m A^T + A *m A *m W *m (A *m A)^T
        = B1 + A *m B1 *m A^T - A *m (W + W) *m A^T by expand.
by rewrite e; sums.
Qed.

End Recovery.

(** AK-B.W: A must be invertible: if Au = 0, then W + uuᵀ and V − uuᵀ have the same two moments as W and V. *)
Theorem singular_A_hides A V W (u : 'cV[F]_n) : A *m u = 0 ->
  residual_1 A (V - u *m u^T) (W + u *m u^T) = residual_1 A V W /\
  residual_2 A (V - u *m u^T) (W + u *m u^T) = residual_2 A V W.
Proof.
move=> Au; have z k (X : 'M[F]_(k, n)) : X *m A *m u = 0 by rewrite -mulmxA Au mulmx0.
by split; rewrite /residual_1 /residual_2; multiply; rewrite ?z Au !mul0mx; sums.
Qed.

End Moments.
