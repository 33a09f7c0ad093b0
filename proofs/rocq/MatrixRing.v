(** * Matrix identities by multiplying out

    Matrices of several sizes are no ring, and [ring] does not speak of them. [expand] multiplies all products out,
    moves transposes to the factors and compares the sums entry by entry, where a product of matrices is an atom of an
    identity over the commutative ring of the entries. Equations like JJ⁻¹ = I are put in by hand before. *)

From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.

Set Implicit Arguments.
Unset Strict Implicit.
Unset Printing Implicit Defensive.

Import GRing.Theory.
Local Open Scope ring_scope.

Section Entries.
Variables (R : comRingType) (m n : nat).
Implicit Types A B : 'M[R]_(m, n).

Lemma entryD A B i j : (A + B) i j = A i j + B i j. Proof. by rewrite mxE. Qed.
Lemma entryN A i j : (- A) i j = - A i j. Proof. by rewrite mxE. Qed.
Lemma entryZ a A i j : (a *: A) i j = a * A i j. Proof. by rewrite mxE. Qed.
Lemma entry0 i j : (0 : 'M[R]_(m, n)) i j = 0. Proof. by rewrite mxE. Qed.

Lemma trmxD A B : (A + B)^T = A^T + B^T. Proof. by rewrite linearD. Qed.
Lemma trmxN A : (- A)^T = - A^T. Proof. by rewrite linearN. Qed.
Lemma trmxZ a A : (a *: A)^T = a *: A^T. Proof. by rewrite linearZ. Qed.

Lemma mulmxZl p a A (B : 'M[R]_(n, p)) : (a *: A) *m B = a *: (A *m B).
Proof. by rewrite scalemxAl. Qed.
Lemma mulmxZr p a A (B : 'M[R]_(n, p)) : A *m (a *: B) = a *: (A *m B).
Proof. by rewrite scalemxAr. Qed.

End Entries.

Ltac multiply := rewrite ?(trmxD, trmxN, trmxZ, trmx_mul, trmxK, trmx1, trmx0, mulmxDl, mulmxDr, mulmxN, mulNmx,
  mulmxZl, mulmxZr, mulmx1, mul1mx, mulmx0, mul0mx, mulmxA).
Ltac atoms i j := repeat match goal with |- context [fun_of_matrix ?A i j] =>
  let x := fresh "x" in set x := (fun_of_matrix A i j); clearbody x end.
Ltac entries := let i := fresh "i" in let j := fresh "j" in
  apply/matrixP=> i j; rewrite ?(entryD, entryN, entryZ, entry0); atoms i j.
Ltac sums := entries; ring.
Ltac expand := multiply; sums.
