(** * The opacity of a thin segment: why expm1

    Claim.  A segment of optical depth x >= 0 has the opacity alpha = 1 - exp(-x).
    In binary32, with exp and expm1 of a relative accuracy of 2^-23:

      -expm1(-x)   is as accurate as expm1: relative error at most 2^-23, any x;
      1 - exp(-x)  has an absolute error of at most 2^-23, so a relative one of
                   2^-23 / alpha: at most 2^-13 where alpha >= 2^-10.

    The latter is no artefact: at x = 1025 / 2^20, where alpha is just above
    2^-10, one exp of that accuracy leads to a relative error of 0.99 * 2^-13.

    Source.  Folklore; Kahan for expm1.  That 1 - y loses nothing by itself if
    1/2 <= y <= 2 is Sterbenz (Floating-Point Computation, 1974): what is lost
    is what exp rounded off.

    Assumptions.  Round to nearest, ties to even; exp and expm1 return binary32
    numbers of the accuracy named, about one unit in the last place.  x is exact.

    The program offers both formulas; this is how they differ. *)

From Coq Require Import Reals Lra.
From Flocq Require Import Core Sterbenz.
From Gappa Require Import Gappa_tactic.
From Volver Require Import Exponential.
Open Scope R_scope.

Definition binary32 (x : R) : Prop := generic_format radix2 (FLT_exp (-149) 24) x.
Definition rnd (x : R) : R := round radix2 (FLT_exp (-149) 24) ZnearestE x.

Local Instance precision_positive : Prec_gt_0 24 := eq_refl.

(** Off by at most [r], relative to the exact number. *)
Definition relative_error_at_most (r computed exact : R) : Prop :=
  Rabs (computed - exact) <= r * Rabs exact.

Lemma rnd_exact (x : R) : binary32 x -> rnd x = x.
Proof. apply round_generic; auto with typeclass_instances. Qed.

(** An integer below 2^24 times a power of 2. *)
Lemma binary32_written (m e : Z) :
  (Z.abs m < 2 ^ 24)%Z -> (-149 <= e)%Z -> binary32 (F2R (Float radix2 m e)).
Proof. intros Hm He. apply generic_format_FLT. now exists (Float radix2 m e). Qed.

Lemma binary32_1 : binary32 1.
Proof.
  replace 1 with (F2R (Float radix2 1 0)) by (unfold F2R; simpl; ring).
  now apply binary32_written.
Qed.

Lemma subtraction_exact (e : R) : binary32 e -> / 2 <= e <= 2 -> rnd (1 - e) = 1 - e.
Proof.
  intros He range. apply rnd_exact, sterbenz; auto with typeclass_instances.
  - exact binary32_1.
  - lra.
Qed.

Theorem opacity_by_expm1 (x expm1 : R) :
  binary32 expm1 -> relative_error_at_most (/ 2 ^ 23) expm1 (exp (- x) - 1) ->
  relative_error_at_most (/ 2 ^ 23) (rnd (- expm1)) (1 - exp (- x)).
Proof.
  intros Hm accuracy. rewrite rnd_exact by now apply generic_format_opp.
  unfold relative_error_at_most in *.
  rewrite <- Rabs_Ropp, (Rabs_minus_sym 1). now replace (- (- expm1 - (1 - exp (- x))))
    with (expm1 - (exp (- x) - 1)) by ring.
Qed.

Theorem opacity_by_subtraction (x e : R) :
  0 <= x -> binary32 e -> relative_error_at_most (/ 2 ^ 23) e (exp (- x)) ->
  Rabs (rnd (1 - e) - (1 - exp (- x))) <= / 2 ^ 23.
Proof.
  unfold relative_error_at_most. intros Hx He accuracy.
  assert (0 < exp (- x)) by apply exp_pos.
  assert (exp (- x) <= 1).
  { rewrite <- exp_0. destruct Hx as [Hx | <-]; [| rewrite Ropp_0; lra].
    left. apply exp_increasing. lra. }
  rewrite (Rabs_pos_eq (exp (- x))) in accuracy by lra.
  apply Rabs_le_inv in accuracy. apply Rabs_le.
  destruct (Rle_dec (/ 2) e) as [large | small].
  - rewrite subtraction_exact by (easy || lra). lra.
  - assert (- bpow radix2 (-25) <= rnd (1 - e) - (1 - e) <= bpow radix2 (-25)).
    { assert (range : 0 <= e <= / 2) by lra. unfold rnd. clear - range. gappa. }
    simpl bpow in *. lra.
Qed.

Corollary opacity_by_subtraction_relative (x e : R) :
  0 <= x -> binary32 e -> relative_error_at_most (/ 2 ^ 23) e (exp (- x)) ->
  / 2 ^ 10 <= 1 - exp (- x) ->
  relative_error_at_most (/ 2 ^ 13) (rnd (1 - e)) (1 - exp (- x)).
Proof.
  intros Hx He accuracy Halpha. unfold relative_error_at_most.
  rewrite (Rabs_pos_eq (1 - exp (- x))) by lra.
  apply Rle_trans with (1 := opacity_by_subtraction x e Hx He accuracy). lra.
Qed.

(** An exp of the same accuracy, and the opacity all but 2^-13 off. *)
Theorem opacity_by_subtraction_loses :
  let x := 1025 / 2 ^ 20 in
  let e := 8380413 / 2 ^ 23 in
  binary32 x /\ binary32 e /\
  relative_error_at_most (/ 2 ^ 23) e (exp (- x)) /\
  / 2 ^ 10 <= 1 - exp (- x) <= / 2 ^ 10 * (1 + / 2 ^ 10) /\
  99 / 100 * / 2 ^ 13 * (1 - exp (- x)) <= Rabs (rnd (1 - e) - (1 - exp (- x))).
Proof.
  intros x e. unfold x, e.
  assert (He : binary32 (8380413 / 2 ^ 23)).
  { replace (8380413 / 2 ^ 23) with (F2R (Float radix2 8380413 (-23)))
      by (unfold F2R; simpl; lra).
    now apply binary32_written. }
  split; [| split; [easy |]].
  { replace (1025 / 2 ^ 20) with (F2R (Float radix2 1025 (-20)))
      by (unfold F2R; simpl; lra).
    now apply binary32_written. }
  rewrite subtraction_exact by (easy || lra). unfold relative_error_at_most.
  assert (low := exp_opp_at_least_cubic (1025 / 2 ^ 20) ltac:(lra)).
  assert (high := exp_opp_at_most (1025 / 2 ^ 20) ltac:(lra)).
  rewrite (Rabs_pos_eq (exp _)), Rabs_pos_eq, Rabs_left by lra. lra.
Qed.
