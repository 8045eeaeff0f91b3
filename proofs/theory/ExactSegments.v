(** * Compositing exact segments is exact

    Claim.  Cut a ray into segments of whatever lengths, give each the radiance
    of its own stretch as colour and 1 - T of its own stretch as opacity.
    Composited in any of the ways of Compositing.v they give the radiance and the
    transmittance of the whole ray.

    Source.  Max, "Optical Models for Direct Volume Rendering" (1995).

    Assumptions.  tau(s(l)) and C(s(l)) tau(s(l)) are continuous on the ray and
    the lengths are not negative; exact arithmetic.

    So compositing is no source of error in the program's methods: all of their
    error, but for rounding, is that of their segments. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Coq Require Import List.
From Volver Require Import Integral Radiance Compositing.
Import ListNotations.
Open Scope R_scope.

Section Segments.
Variables extinction emission : R -> R.

Definition exact_segment (field : R -> R) (D : R) : segment :=
  Segment (radiance field extinction emission D) (1 - transmittance field extinction D).

Fixpoint exact_segments (field : R -> R) (lengths : list R) : list segment :=
  match lengths with
  | [] => []
  | d :: rest => exact_segment field d :: exact_segments (shifted field d) rest
  end.

Definition total (lengths : list R) : R := fold_right Rplus 0 lengths.

Lemma total_nonnegative (lengths : list R) : Forall (Rle 0) lengths -> 0 <= total lengths.
Proof. intros all. induction all; simpl; lra. Qed.

Theorem over_exact_segments (field : R -> R) (m D : R) :
  0 <= m <= D ->
  continuous_on (extinction_along field extinction) D ->
  continuous_on (source field extinction emission) D ->
  over (exact_segment field m) (exact_segment (shifted field m) (D - m)) = exact_segment field D.
Proof.
  intros Hm Htau HC. apply segment_eq; simpl.
  - rewrite (radiance_split field extinction emission m D Hm Htau HC). ring.
  - rewrite (transmittance_split field extinction D Htau m Hm). ring.
Qed.

Theorem exact_segments_compose (field : R -> R) (lengths : list R) :
  Forall (Rle 0) lengths ->
  continuous_on (extinction_along field extinction) (total lengths) ->
  continuous_on (source field extinction emission) (total lengths) ->
  composite (exact_segments field lengths) = exact_segment field (total lengths).
Proof.
  revert field. induction lengths as [| d rest IH]; intros field all Htau HC; simpl in *.
  - unfold exact_segment, radiance, transmittance, optical_depth.
    rewrite !RInt_point. apply segment_eq; simpl; [easy |].
    unfold zero. simpl. rewrite Ropp_0, exp_0. ring.
  - assert (Hd := Forall_inv all). apply Forall_inv_tail in all.
    assert (Hrest := total_nonnegative rest all).
    assert (inside : 0 <= d <= d + total rest) by lra.
    rewrite <- (over_exact_segments field d (d + total rest)) by easy.
    replace (d + total rest - d) with (total rest) by ring.
    rewrite IH; [easy | easy | |].
    + replace (total rest) with (d + total rest - d) by ring.
      exact (shifted_continuous _ _ inside _ Htau).
    + replace (total rest) with (d + total rest - d) by ring.
      exact (shifted_continuous _ _ inside _ HC).
Qed.

Corollary exact_segments_front_to_back (field : R -> R) (lengths : list R) :
  Forall (Rle 0) lengths ->
  continuous_on (extinction_along field extinction) (total lengths) ->
  continuous_on (source field extinction emission) (total lengths) ->
  front_to_back (exact_segments field lengths)
    = Accumulator (radiance field extinction emission (total lengths))
                  (transmittance field extinction (total lengths)).
Proof.
  intros all Htau HC. rewrite front_to_back_is_over, exact_segments_compose by easy.
  unfold exact_segment. simpl. f_equal. ring.
Qed.
End Segments.
