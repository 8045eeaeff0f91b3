(** * Nested rules end to end

    Claim.  The ray [0, D] has n = g m segments of length d.  The inner rule P is
    used on every segment by itself, and at a node inside a segment on the part of
    the segment in front of it.  The outer rule is laid over m groups of g segments
    each (g = 2 for Simpson on the boundaries, 4 for Boole, else 1).  If on a panel
    the inner rule has order p with the constant c_inner, and the outer one q with
    c_outer, then the nested rule misses the radiance by at most

      (c_outer g^q M_outer D D^(q - r)
       + e^L (D sum |w|) G (c_inner M_inner D) D^(p - r)) d^r,   r = min(p, q),

    where M_inner bounds the p-th derivative of the extinction along the ray,
    M_outer the q-th of the integrand, G the source, and no depth is below -L.

    Source.  Etiene, Kirby and Silva, "A Study Of Discretization Errors In Volume
    Rendering Integral Approximations", equation 22, whose constants stay inside O().

    Assumptions.  The extinction has p derivatives along the ray and the integrand
    q, two-sided at the ends; D > 0, m > 0 and g > 0; exact arithmetic and an exact
    exponential.  L = 0 if extinction and inner weights are not negative.

    This is what stands behind the order that the program expects of a nested rule:
    the theorem has no hypothesis on a rule beyond what Quadrature.v proves of it. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Sums Derivatives Quadrature Composite Order.
Import ListNotations.
Open Scope R_scope.

(** The depth at x into segment j: whole segments, and the part of the last one. *)
Definition inner_depth (P : rule) (sigma : R -> R) (d : R) (j : nat) (x : R) : R :=
  composite P sigma 0 d j + apply_rule P sigma (INR j * d) x.

(** Nodes and weights of an outer rule over a group of segments: the segment in the
    group, the place in the segment on [0, 1], the weight. *)
Definition group_rule := list (nat * R * R).

Definition within_group (g : nat) (O : group_rule) : Prop :=
  forall s o w, In (s, o, w) O -> (s < g)%nat /\ 0 <= o <= 1.

(** The same as a rule on the whole group. *)
Definition on_group (g : nat) (O : group_rule) : rule :=
  map (fun '(s, o, w) => ((INR s + o) / INR g, w)) O.

Definition total_weight (O : group_rule) : R := sum_over O (fun '(s, o, w) => Rabs w).

Section Nested.
Variables field extinction emission : R -> R.
Let sigma := extinction_along field extinction.

(** A node of the ray is a group k and a node (s, o, w) of the outer rule. *)
Definition ray_node : Type := nat * (nat * R * R).
Definition ray_nodes (O : group_rule) (m : nat) : list ray_node := list_prod (seq 0 m) O.
Definition segment (g : nat) : ray_node -> nat := fun '(k, (s, _, _)) => (k * g + s)%nat.
Definition offset (d : R) : ray_node -> R := fun '(_, (_, o, _)) => o * d.
Definition position (g : nat) (d : R) (i : ray_node) : R := INR (segment g i) * d + offset d i.
Definition weight (g : nat) (d : R) : ray_node -> R := fun '(_, (_, _, w)) => INR g * d * w.
Definition depth (P : rule) (g : nat) (d : R) (i : ray_node) : R :=
  inner_depth P sigma d (segment g i) (offset d i).

(** What the program computes on m groups. *)
Definition nested_rule (P : rule) (g : nat) (O : group_rule) (d : R) (m : nat) : R :=
  nested field extinction emission (ray_nodes O m) (weight g d) (position g d) (depth P g d).

(** Where nodes lie. *)
Lemma position_within (g : nat) (O : group_rule) (d : R) (m : nat) (i : ray_node) :
  within_group g O -> 0 <= d -> In i (ray_nodes O m) ->
  0 <= offset d i <= d /\ 0 <= INR (segment g i) * d /\ position g d i <= INR (g * m) * d.
Proof.
  destruct i as [k [[s o] w]]. intros HO Hd Hi. apply in_prod_iff in Hi as [Hk Hi].
  apply in_seq in Hk. destruct (HO s o w Hi) as [Hs Ho].
  unfold position. simpl segment. simpl offset.
  assert (0 <= o * d <= d) by (split; nra).
  assert (0 <= INR (k * g + s)) by apply pos_INR.
  assert (INR (k * g + s) + 1 <= INR (g * m)) by (rewrite <- S_INR; apply le_INR; nia).
  split; [easy |]. split; nra.
Qed.

(** With exact depths it is the outer rule, group after group. *)
Lemma nested_with_exact_depths (g : nat) (O : group_rule) (f : R -> R) (d : R) (m : nat) :
  (0 < g)%nat ->
  (forall i, In i (ray_nodes O m) ->
     f (position g d i) = integrand field extinction emission (position g d i)) ->
  nested field extinction emission (ray_nodes O m) (weight g d) (position g d)
    (depth_at field extinction (position g d))
  = composite (on_group g O) f 0 (INR g * d) m.
Proof.
  intros Hg Hf. assert (INR g <> 0) by (apply not_0_INR; lia).
  unfold nested, ray_nodes, ray_node. rewrite sum_over_pairs. apply sum_over_ext. intros k Hk.
  unfold apply_rule, on_group. rewrite sum_over_map, <- sum_over_scal.
  apply sum_over_ext. intros [[s o] w] Hi.
  replace (0 + INR k * (INR g * d) + (INR s + o) / INR g * (INR g * d))
    with (position g d (k, (s, o, w)))
    by (unfold position; simpl; rewrite plus_INR, mult_INR; now field).
  rewrite Hf by now apply in_prod.
  unfold integrand, transmittance, depth_at, weight. ring.
Qed.

Lemma total_weight_of_ray (g : nat) (O : group_rule) (d : R) (m : nat) :
  0 <= d -> sum_over (ray_nodes O m) (fun i => Rabs (weight g d i))
    = INR (g * m) * d * total_weight O.
Proof.
  intros Hd. unfold ray_nodes, ray_node. rewrite sum_over_pairs.
  rewrite sum_over_ext with (g := fun _ => INR g * d * total_weight O).
  - rewrite sum_over_seq_constant, mult_INR. unfold total_weight. ring.
  - intros k _. unfold total_weight. rewrite <- sum_over_scal. apply sum_over_ext.
    intros [[s o] w] _. simpl. assert (0 <= INR g) by apply pos_INR.
    rewrite !Rabs_mult, (Rabs_pos_eq (INR g)), (Rabs_pos_eq d); easy.
Qed.

(** The inner rule, on a ray of length D in segments no longer than d. *)
Lemma inner_depth_error (P : rule) (p : nat) (c M D d x : R) (tau : nat -> R -> R) (j : nat) :
  panel_bound P p c -> derivatives p tau 0 D -> (forall l, 0 <= l <= D -> Rabs (tau p l) <= M) ->
  0 <= x <= d -> INR j * d + x <= D ->
  Rabs (RInt (tau 0%nat) 0 (INR j * d + x) - inner_depth P (tau 0%nat) d j x)
    <= c * M * D * d ^ p.
Proof.
  intros HP Htau HM Hx HD. assert (Hc := panel_bound_nonnegative P p c HP).
  assert (Hj : 0 <= INR j * d) by (apply Rmult_le_pos; [apply pos_INR | lra]).
  assert (M_pos : 0 <= M) by (eapply Rle_trans; [apply Rabs_pos | apply (HM 0); lra]).
  assert (cM_pos : 0 <= c * M) by now apply Rmult_le_pos.
  assert (whole := composite_bound P p c tau 0 d M j HP ltac:(lra)).
  rewrite Rplus_0_l in whole. destruct HP as [Hp HP].
  assert (part := HP tau (INR j * d) x M ltac:(lra)).
  unfold inner_depth.
  assert (integral : RInt (tau 0%nat) 0 (INR j * d + x)
    = RInt (tau 0%nat) 0 (INR j * d) + RInt (tau 0%nat) (INR j * d) (INR j * d + x)).
  { symmetry. apply (RInt_Chasles (V := R_CompleteNormedModule));
      apply (derivatives_integrable p tau 0 D); (easy || lra). }
  rewrite integral. replace (_ + _ - (_ + _)) with
    ((RInt (tau 0%nat) 0 (INR j * d) - composite P (tau 0%nat) 0 d j)
     + (RInt (tau 0%nat) (INR j * d) (INR j * d + x) - apply_rule P (tau 0%nat) (INR j * d) x))
    by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  apply Rle_trans with (c * M * (INR j * d) * d ^ p + c * M * x ^ (p + 1)).
  - apply Rplus_le_compat; [apply whole | apply part];
      solve [apply derivatives_within with 0 D; (easy || lra) | intros l Hl; apply HM; lra].
  - assert (power : x ^ (p + 1) <= x * d ^ p).
    { rewrite pow_add, pow_1, Rmult_comm. apply Rmult_le_compat_l; [lra | now apply pow_incr]. }
    apply (Rmult_le_compat_l (c * M)) in power; [| easy].
    assert (0 <= c * M * d ^ p) by (apply Rmult_le_pos; [easy | apply pow_le; lra]).
    assert (c * M * d ^ p * (INR j * d + x) <= c * M * d ^ p * D)
      by (apply Rmult_le_compat_l; easy). lra.
Qed.

(** The extinction tau 0 and the integrand f 0 with their derivatives along the ray. *)
Record smooth_ray (p q : nat) (tau f : nat -> R -> R) (D M_inner M_outer G : R) : Prop := {
  extinction_is : tau 0%nat = sigma;
  extinction_derivatives : derivatives p tau 0 D;
  extinction_bound : forall l, 0 <= l <= D -> Rabs (tau p l) <= M_inner;
  integrand_is : forall l, 0 <= l <= D -> f 0%nat l = integrand field extinction emission l;
  integrand_derivatives : derivatives q f 0 D;
  integrand_bound : forall l, 0 <= l <= D -> Rabs (f q l) <= M_outer;
  source_bound : forall l, 0 <= l <= D -> Rabs (source field extinction emission l) <= G }.

Section Bound.
Variables (P : rule) (p : nat) (c_inner M_inner : R) (tau : nat -> R -> R).
Variables (g : nat) (O : group_rule) (q : nat) (c_outer M_outer : R) (f : nat -> R -> R).
Variables (D G : R) (m : nat).
Let d := D / INR (g * m).

Hypothesis inner_rule : panel_bound P p c_inner.
Hypothesis outer_rule : panel_bound (on_group g O) q c_outer.
Hypothesis outer_nodes : within_group g O.
Hypotheses (some_length : 0 < D) (some_segment : (0 < g * m)%nat).

Hypothesis ray : smooth_ray p q tau f D M_inner M_outer G.

Lemma total_length : INR (g * m) * d = D.
Proof. unfold d. field. apply not_0_INR. lia. Qed.

Lemma segment_positive : 0 < d <= D.
Proof. now apply segment_length. Qed.

Theorem nested_bound (L : R) :
  let r := Nat.min p q in
  (forall l, 0 <= l <= D -> - L <= optical_depth field extinction l) ->
  (forall i, In i (ray_nodes O m) -> - L <= depth P g d i) ->
  Rabs (radiance field extinction emission D - nested_rule P g O d m)
    <= (c_outer * INR g ^ q * M_outer * D * D ^ (q - r)
        + exp L * (D * total_weight O) * G * (c_inner * M_inner * D) * D ^ (p - r)) * d ^ r.
Proof.
  intros r exact_depths depths.
  destruct ray as [extinction_is extinction_derivatives extinction_bound
                   integrand_is integrand_derivatives integrand_bound source_bound].
  assert (Hd := segment_positive). assert (HD := total_length).
  assert (Hc := panel_bound_nonnegative P p c_inner inner_rule).
  assert (inside : forall i, In i (ray_nodes O m) ->
    0 <= offset d i <= d /\ 0 <= INR (segment g i) * d /\ 0 <= position g d i <= D).
  { intros i Hi. assert (H := position_within g O d m i outer_nodes ltac:(lra) Hi).
    rewrite HD in H. unfold position in *. lra. }
  apply min_order_bound; fold sigma.
  - exact Hd.
  - assert (0 <= M_inner) by (eapply Rle_trans; [apply Rabs_pos | apply (extinction_bound 0); lra]).
    repeat apply Rmult_le_pos; lra.
  - eapply Rle_trans; [apply Rabs_pos | apply (source_bound 0); lra].
  - intros i Hi. apply exact_depths, inside, Hi.
  - exact depths.
  - intros i Hi. apply source_bound, inside, Hi.
  - rewrite total_weight_of_ray, HD by lra. apply Rle_refl.
  - intros i Hi. destruct (inside i Hi) as [Hoffset [_ Hposition]].
    rewrite Rabs_minus_sym. unfold depth, depth_at, optical_depth, position in *.
    fold sigma. rewrite <- extinction_is.
    now apply inner_depth_error.
  - rewrite nested_with_exact_depths with (f := f 0%nat);
      [| lia | intros i Hi; apply integrand_is, inside, Hi].
    unfold radiance. rewrite <- (RInt_ext (f 0%nat)).
    2: { intros l. rewrite Rmin_left, Rmax_right by lra. intros Hl. apply integrand_is. lra. }
    assert (length : INR m * (INR g * d) = D) by (rewrite <- HD, mult_INR; ring).
    assert (outer := composite_bound (on_group g O) q c_outer f 0 (INR g * d) M_outer m).
    rewrite length, Rplus_0_l, Rpow_mult_distr in outer.
    replace (c_outer * INR g ^ q * M_outer * D * d ^ q)
      with (c_outer * M_outer * D * (INR g ^ q * d ^ q)) by ring.
    apply outer; try easy. apply Rmult_le_pos; [apply pos_INR | lra].
Qed.

(** A medium that only absorbs, under an inner rule with positive weights. *)
Corollary nested_bound_absorbing :
  let r := Nat.min p q in
  (forall l, 0 <= l <= D -> 0 <= sigma l) ->
  (forall c w, In (c, w) P -> 0 <= c <= 1 /\ 0 <= w) ->
  Rabs (radiance field extinction emission D - nested_rule P g O d m)
    <= (c_outer * INR g ^ q * M_outer * D * D ^ (q - r)
        + D * total_weight O * G * (c_inner * M_inner * D) * D ^ (p - r)) * d ^ r.
Proof.
  intros r absorbing positive. assert (Hd := segment_positive). assert (HD := total_length).
  assert (rule_nonnegative : forall a h, 0 <= a -> 0 <= h -> a + h <= D ->
    0 <= apply_rule P sigma a h).
  { intros a h Ha Hh Hah. apply Rmult_le_pos; [easy |]. apply sum_over_nonnegative.
    intros [c w] Hcw. destruct (positive c w Hcw). apply Rmult_le_pos; [easy |].
    apply absorbing. split; nra. }
  rewrite <- (Rmult_1_l (D * total_weight O)), <- exp_0. apply nested_bound.
  - intros l Hl. rewrite Ropp_0. apply RInt_ge_0; [lra | | intros x Hx; apply absorbing; lra].
    destruct ray as [extinction_is extinction_derivatives _ _ _ _ _], inner_rule as [Hp _].
    fold sigma. rewrite <- extinction_is.
    apply (derivatives_integrable p tau 0 D); (easy || lra).
  - intros i Hi. rewrite Ropp_0.
    destruct (position_within g O d m i outer_nodes ltac:(lra) Hi) as [Ho [Hs Hposition]].
    rewrite HD in Hposition. unfold position, depth, inner_depth in *.
    apply Rplus_le_le_0_compat; [| apply rule_nonnegative; lra].
    apply sum_over_nonnegative. intros k Hk. apply in_seq in Hk. rewrite Rplus_0_l.
    assert (0 <= INR k) by apply pos_INR.
    assert (INR k + 1 <= INR (segment g i)) by (rewrite <- S_INR; apply le_INR; lia).
    apply rule_nonnegative; nra.
Qed.
End Bound.
End Nested.
