(** * Rounding in front-to-back compositing

    Claim.  Let n samples, each with an emission C and an opacity alpha in [0, 1],
    be composited from the eye on, every operation rounded to nearest:

      I <- rnd(I + rnd(rnd(C alpha) T)),    T <- rnd(T rnd(1 - alpha)).

    If nothing is rounded the result is that of Compositing.v, and

      |I - I_exact| + |T - T_exact| <= n 2^-22    in binary32, if n 2^-22 <= 1,
      |I - I_exact| + |T - T_exact| <= n 2^-51    in binary64, if n 2^-51 <= 1.

    Source.  The accumulation is Higham's (Accuracy and Stability of Numerical
    Algorithms, 2002) with absolute errors: one step's rounding is bounded by
    Gappa, whose proof Coq checks again, and the exact step does not magnify the
    sum of the two errors, as what I gains with T, T loses.

    Assumptions.  Ties go to even and subnormal numbers are kept.  Nothing
    overflows, as no number exceeds 4.  In the program C and alpha are numbers of
    the format; nothing here depends on that.

    These are the program's operations in the program's order, for the opacities
    it has at hand: what rounding does to these is Opacity.v. *)

From Coq Require Import Reals Lra List.
From Flocq Require Import Core.
From Gappa Require Import Gappa_tactic.
From Volver Require Import Compositing.
Import ListNotations.
Open Scope R_scope.

Record sample := Sample { emission : R; alpha : R }.

(** The segment that a sample stands for. *)
Definition premultiplied (s : sample) : segment := Segment (emission s * alpha s) (alpha s).
Definition exact (samples : list sample) : accumulator :=
  front_to_back (map premultiplied samples).

(** The sum of the errors of colour and transmittance. *)
Definition error (computed exact : accumulator) : R :=
  Rabs (accumulated computed - accumulated exact) + Rabs (transmitted computed - transmitted exact).

Section Format.
(** To the nearest number of [prec] bits, or multiple of 2^[emin] where that is coarser. *)
Variables emin prec : Z.

Definition rnd (x : R) : R := round radix2 (FLT_exp emin prec) ZnearestE x.

Definition rounded_step (so_far : accumulator) (next : sample) : accumulator := Accumulator
  (rnd (accumulated so_far + rnd (rnd (emission next * alpha next) * transmitted so_far)))
  (rnd (transmitted so_far * rnd (1 - alpha next))).
Definition rounded (samples : list sample) : accumulator :=
  fold_left rounded_step samples (Accumulator 0 1).

Definition unit_sample (s : sample) : Prop := 0 <= emission s <= 1 /\ 0 <= alpha s <= 1.

(** What one rounded step may start from. *)
Definition in_range (a : accumulator) : Prop := 0 <= accumulated a <= 2 /\ 0 <= transmitted a <= 1.

(** What one rounded step adds to the error, and that it stays in range but for [accumulated]. *)
Definition step_error (u : R) : Prop := forall (a : accumulator) (s : sample),
  in_range a -> unit_sample s ->
  error (rounded_step a s) (accumulate a (premultiplied s)) <= u /\
  0 <= accumulated (rounded_step a s) /\ 0 <= transmitted (rounded_step a s) <= 1.

Lemma error_triangle (a b c : accumulator) : error a c <= error a b + error b c.
Proof.
  unfold error.
  assert (H := Rabs_triang (accumulated a - accumulated b) (accumulated b - accumulated c)).
  assert (H' := Rabs_triang (transmitted a - transmitted b) (transmitted b - transmitted c)).
  replace (accumulated a - accumulated c)
    with (accumulated a - accumulated b + (accumulated b - accumulated c)) by ring.
  replace (transmitted a - transmitted c)
    with (transmitted a - transmitted b + (transmitted b - transmitted c)) by ring.
  lra.
Qed.

(** What the colour's error gains from the transmittance's, the latter loses. *)
Lemma exact_step_contracts (a b : accumulator) (s : sample) :
  unit_sample s ->
  error (accumulate a (premultiplied s)) (accumulate b (premultiplied s)) <= error a b.
Proof.
  intros [HC Halpha]. unfold error, accumulate, premultiplied. simpl.
  set (C := emission s) in *. set (x := alpha s) in *.
  set (dI := accumulated a - accumulated b). set (dT := transmitted a - transmitted b).
  replace (_ - _) with (dI + C * x * dT) at 1 by (unfold dI, dT; ring).
  replace (_ * _ - _ * _) with ((1 - x) * dT) by (unfold dT; ring).
  assert (H := Rabs_triang dI (C * x * dT)).
  assert (product : 0 <= C * x <= 1 * x)
    by (split; [apply Rmult_le_pos | apply Rmult_le_compat_r]; lra).
  rewrite Rabs_mult, (Rabs_pos_eq (C * x)) in H by lra.
  rewrite Rabs_mult, (Rabs_pos_eq (1 - x)) by lra.
  assert (C * x * Rabs dT <= 1 * x * Rabs dT) by (apply Rmult_le_compat_r; [apply Rabs_pos | lra]).
  lra.
Qed.

(** Colour and opacity of the exact result are at most 1. *)
Lemma exact_bounds (samples : list sample) :
  Forall unit_sample samples ->
  0 <= accumulated (exact samples) <= 1 /\ 0 <= transmitted (exact samples) <= 1.
Proof.
  intros all. unfold exact. rewrite front_to_back_is_over. simpl.
  destruct (composite_physical 1 (map premultiplied samples)) as [H H']; [| lra].
  apply Forall_map. revert all. apply Forall_impl. intros s [HC Halpha].
  unfold physical, premultiplied. simpl.
  assert (0 <= emission s * alpha s) by (apply Rmult_le_pos; lra).
  assert (emission s * alpha s <= 1 * alpha s) by (apply Rmult_le_compat_r; lra).
  lra.
Qed.

Lemma errors_add_up (u : R) (samples : list sample) :
  0 <= u -> step_error u -> Forall unit_sample samples -> INR (length samples) * u <= 1 ->
  error (rounded samples) (exact samples) <= INR (length samples) * u /\
  0 <= accumulated (rounded samples) /\ 0 <= transmitted (rounded samples) <= 1.
Proof.
  intros Hu step. induction samples as [| s samples IH] using rev_ind; intros all few.
  - unfold error. simpl. rewrite !Rminus_eq_0, Rabs_R0. lra.
  - apply Forall_app in all. destruct all as [all one]. apply Forall_inv in one.
    rewrite app_length, plus_INR in few |- *. simpl (INR (length [s])) in few |- *.
    destruct IH as [before [I_positive T_range]]; [easy | lra |].
    replace (rounded (samples ++ [s])) with (rounded_step (rounded samples) s)
      by (unfold rounded; now rewrite fold_left_app).
    replace (exact (samples ++ [s])) with (accumulate (exact samples) (premultiplied s))
      by (unfold exact, front_to_back; now rewrite map_app, fold_left_app).
    assert (start : in_range (rounded samples)).
    { split; [split; [easy |] | easy]. destruct (exact_bounds samples all) as [bound _].
      assert (H := Rle_abs (accumulated (rounded samples) - accumulated (exact samples))).
      assert (H' := Rabs_pos (transmitted (rounded samples) - transmitted (exact samples))).
      unfold error in before. lra. }
    destruct (step _ _ start one) as [here range]. split; [| easy].
    assert (H := error_triangle (rounded_step (rounded samples) s)
      (accumulate (rounded samples) (premultiplied s))
      (accumulate (exact samples) (premultiplied s))).
    assert (H' := exact_step_contracts (rounded samples) (exact samples) s one). lra.
Qed.
End Format.

Definition binary32_rounded : list sample -> accumulator := rounded (-149) 24.
Definition binary64_rounded : list sample -> accumulator := rounded (-1074) 53.

(** For Gappa, which takes numbers and operations but no records: the colour is off by at
    most 3/4 of the bound, as it may exceed 1, the transmittance by 1/4. *)
Ltac step_by_gappa quarter :=
  intros [I T] [C x] [HI HT] [HC Hx];
  unfold error, rounded_step, accumulate, premultiplied, rnd;
  cbn [accumulated transmitted emission alpha colour opacity] in *;
  replace (T * (C * x)) with (C * x * T) by ring;
  match goal with |- Rabs ?colour_error + Rabs ?transmittance_error <= _ /\ _ =>
    assert (Rabs colour_error <= 3 * quarter) by gappa;
    assert (Rabs transmittance_error <= quarter) by gappa
  end;
  simpl bpow in *; split; [lra | split; gappa].

Theorem binary32_step : step_error (-149) 24 (/ 2 ^ 22).
Proof. step_by_gappa (bpow radix2 (-24)). Qed.

Theorem binary64_step : step_error (-1074) 53 (/ 2 ^ 51).
Proof. step_by_gappa (bpow radix2 (-53)). Qed.

Theorem binary32_roundoff (samples : list sample) :
  Forall unit_sample samples -> INR (length samples) * / 2 ^ 22 <= 1 ->
  Rabs (accumulated (binary32_rounded samples) - accumulated (exact samples))
    + Rabs (transmitted (binary32_rounded samples) - transmitted (exact samples))
    <= INR (length samples) * / 2 ^ 22.
Proof. apply errors_add_up; [lra | exact binary32_step]. Qed.

Theorem binary64_roundoff (samples : list sample) :
  Forall unit_sample samples -> INR (length samples) * / 2 ^ 51 <= 1 ->
  Rabs (accumulated (binary64_rounded samples) - accumulated (exact samples))
    + Rabs (transmitted (binary64_rounded samples) - transmitted (exact samples))
    <= INR (length samples) * / 2 ^ 51.
Proof. apply errors_add_up; [lra | exact binary64_step]. Qed.
