(** * The first terms of the series of exp(-x) enclose it

    Claim.  For x >= 0,  1 - x <= exp(-x) <= 1 - x + x^2/2, and
    1 - x + x^2/2 - x^3/6 <= exp(-x).  Besides, (1 + x/2) (1 - exp(-x)) <= x.

    Source.  Textbook calculus: each difference is 0 at 0 and its derivative is
    the difference before.

    Assumptions.  None but x >= 0. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Derivatives.
Open Scope R_scope.

(** F b >= 0 as F 0 = 0 and F has the derivative f; leaves that f >= 0. *)
Ltac by_derivative F f b :=
  apply Rle_trans with (F 0); [right; cbv beta; rewrite Ropp_0, exp_0; field |];
  apply (nondecreasing F f b); [easy | intros x _; auto_derive; [easy | field] |].

Lemma exp_opp_at_least (x : R) : 1 - x <= exp (- x).
Proof. apply exp_ineq1_le. Qed.

Theorem exp_opp_at_most (b : R) : 0 <= b -> exp (- b) <= 1 - b + b ^ 2 / 2.
Proof.
  intros Hb. cut (0 <= 1 - b + b ^ 2 / 2 - exp (- b)); [lra |].
  by_derivative (fun x => 1 - x + x ^ 2 / 2 - exp (- x)) (fun x => exp (- x) - (1 - x)) b.
  intros x _. assert (H := exp_opp_at_least x). lra.
Qed.

Theorem exp_opp_at_least_cubic (b : R) : 0 <= b -> 1 - b + b ^ 2 / 2 - b ^ 3 / 6 <= exp (- b).
Proof.
  intros Hb. cut (0 <= exp (- b) - (1 - b + b ^ 2 / 2 - b ^ 3 / 6)); [lra |].
  by_derivative (fun x => exp (- x) - (1 - x + x ^ 2 / 2 - x ^ 3 / 6))
    (fun x => 1 - x + x ^ 2 / 2 - exp (- x)) b.
  intros x Hx. assert (H := exp_opp_at_most x ltac:(lra)). lra.
Qed.

Theorem opacity_at_most (b : R) : 0 <= b -> (1 + b / 2) * (1 - exp (- b)) <= b.
Proof.
  intros Hb. cut (0 <= b - (1 + b / 2) * (1 - exp (- b))); [lra |].
  by_derivative (fun x => x - (1 + x / 2) * (1 - exp (- x)))
    (fun x => (1 - (1 + x) * exp (- x)) / 2) b.
  intros x Hx. cut ((1 + x) * exp (- x) <= exp x * exp (- x)).
  - rewrite <- exp_plus, Rplus_opp_r, exp_0. lra.
  - apply Rmult_le_compat_r; [left; apply exp_pos | apply exp_ineq1_le].
Qed.
