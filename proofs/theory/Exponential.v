(** * The first terms of the series of exp(-x) enclose it

    Claim.  For x >= 0,  1 - x <= exp(-x) <= 1 - x + x^2/2, and
    1 - x + x^2/2 - x^3/6 <= exp(-x).  Besides, (1 + x/2) (1 - exp(-x)) <= x.

    Source.  Textbook calculus: each difference is 0 at 0 and its derivative is
    the difference before.

    Assumptions.  None but x >= 0. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral.
Open Scope R_scope.

Lemma nonnegative_by_derivative (F f : R -> R) (b : R) :
  0 <= b -> F 0 = 0 ->
  (forall x, 0 <= x <= b -> is_derive F x (f x)) ->
  (forall x, 0 <= x <= b -> continuous f x) ->
  (forall x, 0 <= x <= b -> 0 <= f x) -> 0 <= F b.
Proof.
  intros Hb HF0 HF Hf positive.
  assert (integral := integral_of_derivative F f b Hb HF0 HF Hf).
  rewrite <- (is_RInt_unique _ _ _ _ integral).
  apply RInt_ge_0; [easy | now eexists; apply integral | intros x Hx; apply positive; lra].
Qed.

(** The side conditions of the above, but for the sign. *)
Ltac by_derivative F f b := apply (nonnegative_by_derivative F f b);
  [easy | rewrite Ropp_0, exp_0; field | intros x _; auto_derive; [easy | field]
  | intros x _; apply (ex_derive_continuous (V := R_NormedModule)); now auto_derive |].

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
