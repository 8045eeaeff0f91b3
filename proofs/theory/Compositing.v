(** * Compositing: in whatever order, the same colour

    Claim.  A segment of the ray has a premultiplied colour c (what it emits to
    its front) and an opacity alpha.  Of two segments, the front one over the one
    behind it is

      (c1 + (1 - alpha1) c2,  alpha1 + (1 - alpha1) alpha2).

    [over] is associative, so segments give one and the same colour and opacity
    composited from front to back with the accumulated transmittance T, from back
    to front, or by any binary tree over them.  If 0 <= c <= Cmax alpha for each
    segment, that holds of the whole, and a ray that ends early, at transmittance
    T, leaves out a colour between 0 and T Cmax.

    Source.  Porter and Duff, "Compositing Digital Images" (1984); Levoy (1990)
    for early ray termination.

    Assumptions.  Exact arithmetic.  The bounds need the named inequalities and
    opacities between 0 and 1, the equations nothing.

    The program composites in three orders, and in exact arithmetic it takes them
    for the same number; the bound of early termination is one it states.  That
    segments may be exact is ExactSegments.v, what rounding does Roundoff.v. *)

From Coq Require Import Reals Lra List.
Import ListNotations.
Open Scope R_scope.

Record segment := Segment { colour : R; opacity : R }.

Definition over (front behind : segment) : segment := Segment
  (colour front + (1 - opacity front) * colour behind)
  (opacity front + (1 - opacity front) * opacity behind).
Definition clear : segment := Segment 0 0.

(** Segments come in the order in which the ray meets them. *)
Definition composite (segments : list segment) : segment := fold_right over clear segments.

(** From the eye on: the colour so far and the transmittance so far. *)
Record accumulator := Accumulator { accumulated : R; transmitted : R }.
Definition accumulate (so_far : accumulator) (next : segment) : accumulator := Accumulator
  (accumulated so_far + transmitted so_far * colour next)
  (transmitted so_far * (1 - opacity next)).
Definition front_to_back (segments : list segment) : accumulator :=
  fold_left accumulate segments (Accumulator 0 1).

(** From the far end on, before a background. *)
Definition back_to_front (background : R) (segments : list segment) : R :=
  fold_right (fun front behind => colour front + (1 - opacity front) * behind)
    background segments.

(** * The algebra of [over] *)

Lemma segment_eq (x y : segment) : colour x = colour y -> opacity x = opacity y -> x = y.
Proof. destruct x, y. simpl. now intros -> ->. Qed.

Theorem over_associative (x y z : segment) : over x (over y z) = over (over x y) z.
Proof. apply segment_eq; simpl; ring. Qed.

Theorem over_clear_left (x : segment) : over clear x = x.
Proof. apply segment_eq; simpl; ring. Qed.

Theorem over_clear_right (x : segment) : over x clear = x.
Proof. apply segment_eq; simpl; ring. Qed.

Lemma composite_app (front behind : list segment) :
  composite (front ++ behind) = over (composite front) (composite behind).
Proof.
  induction front as [| x front IH]; simpl.
  - now rewrite over_clear_left.
  - now rewrite IH, over_associative.
Qed.

(** * Three orders *)

Lemma accumulate_all (segments : list segment) (C T : R) :
  fold_left accumulate segments (Accumulator C T)
    = Accumulator (C + T * colour (composite segments))
                  (T * (1 - opacity (composite segments))).
Proof.
  revert C T. induction segments as [| x segments IH]; intros C T; simpl.
  - f_equal; ring.
  - unfold accumulate at 2. simpl. rewrite IH. f_equal; ring.
Qed.

Theorem front_to_back_is_over (segments : list segment) :
  front_to_back segments
    = Accumulator (colour (composite segments)) (1 - opacity (composite segments)).
Proof. unfold front_to_back. rewrite accumulate_all. f_equal; ring. Qed.

Lemma back_to_front_is_over (background : R) (segments : list segment) :
  back_to_front background segments
    = colour (composite segments) + (1 - opacity (composite segments)) * background.
Proof.
  induction segments as [| x segments IH]; simpl; [| rewrite IH]; ring.
Qed.

Theorem front_to_back_is_back_to_front (background : R) (segments : list segment) :
  accumulated (front_to_back segments) + transmitted (front_to_back segments) * background
    = back_to_front background segments.
Proof. now rewrite front_to_back_is_over, back_to_front_is_over. Qed.

(** A binary tree over the segments, balanced or not. *)
Inductive tree := Leaf (only : segment) | Node (front behind : tree).

Fixpoint leaves (whole : tree) : list segment :=
  match whole with
  | Leaf only => [only]
  | Node front behind => leaves front ++ leaves behind
  end.

Fixpoint merged (whole : tree) : segment :=
  match whole with
  | Leaf only => only
  | Node front behind => over (merged front) (merged behind)
  end.

Theorem tree_is_over (whole : tree) : merged whole = composite (leaves whole).
Proof.
  induction whole as [only | front IHfront behind IHbehind]; simpl.
  - now rewrite over_clear_right.
  - now rewrite IHfront, IHbehind, composite_app.
Qed.

Corollary tree_is_front_to_back (whole : tree) :
  front_to_back (leaves whole) = Accumulator (colour (merged whole)) (1 - opacity (merged whole)).
Proof. now rewrite front_to_back_is_over, tree_is_over. Qed.

(** * Bounds *)

(** No more opaque than solid, and no brighter than [Cmax]. *)
Definition physical (Cmax : R) (x : segment) : Prop :=
  0 <= opacity x <= 1 /\ 0 <= colour x <= Cmax * opacity x.

Lemma over_physical (Cmax : R) (x y : segment) :
  physical Cmax x -> physical Cmax y -> physical Cmax (over x y).
Proof.
  intros [Hx Cx] [Hy Cy]. unfold physical. simpl.
  assert (0 <= (1 - opacity x) * opacity y) by (apply Rmult_le_pos; lra).
  assert ((1 - opacity x) * opacity y <= (1 - opacity x) * 1) by (apply Rmult_le_compat_l; lra).
  assert (0 <= (1 - opacity x) * colour y) by (apply Rmult_le_pos; lra).
  assert ((1 - opacity x) * colour y <= (1 - opacity x) * (Cmax * opacity y))
    by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

Theorem composite_physical (Cmax : R) (segments : list segment) :
  Forall (physical Cmax) segments -> physical Cmax (composite segments).
Proof.
  intros all. induction all as [| x segments Hx _ IH]; simpl.
  - unfold physical. simpl. lra.
  - now apply over_physical.
Qed.

Theorem compositing_bounds (Cmax background : R) (segments : list segment) :
  0 <= background <= Cmax -> Forall (physical Cmax) segments ->
  0 <= back_to_front background segments <= Cmax.
Proof.
  intros Hbackground all. rewrite back_to_front_is_over.
  destruct (composite_physical Cmax segments all) as [Halpha Hcolour].
  assert (0 <= (1 - opacity (composite segments)) * background) by (apply Rmult_le_pos; lra).
  assert ((1 - opacity (composite segments)) * background
    <= (1 - opacity (composite segments)) * Cmax) by (apply Rmult_le_compat_l; lra).
  lra.
Qed.

Theorem early_termination (Cmax : R) (kept left_out : list segment) :
  0 <= Cmax -> Forall (physical Cmax) kept -> Forall (physical Cmax) left_out ->
  0 <= accumulated (front_to_back (kept ++ left_out)) - accumulated (front_to_back kept)
    <= transmitted (front_to_back kept) * Cmax.
Proof.
  intros HCmax all_kept all_left_out. rewrite !front_to_back_is_over, composite_app. simpl.
  destruct (composite_physical Cmax kept all_kept) as [Hkept _].
  destruct (composite_physical Cmax left_out all_left_out) as [Halpha Hcolour].
  set (front := composite kept) in *. set (behind := composite left_out) in *.
  assert (Cmax * opacity behind <= Cmax * 1) by (apply Rmult_le_compat_l; lra).
  assert (0 <= (1 - opacity front) * colour behind) by (apply Rmult_le_pos; lra).
  assert ((1 - opacity front) * colour behind <= (1 - opacity front) * Cmax)
    by (apply Rmult_le_compat_l; lra).
  lra.
Qed.
