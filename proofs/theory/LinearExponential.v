(** * A linear exponential per segment: first order, whatever the rules

    Claim.  Let every segment attenuate by 1 - q_j in place of exp(- q_j).

    - If 0 <= q_j <= 1, the product of the 1 - q_j misses exp(- sum_j q_j) by at
      most sum_j q_j^2 / 2, and is never above it.
    - Where the extinction is at most tau_max and tau_max d <= 1, that is at most
      tau_max^2 D d / 2, at every node.  Hence a nested rule whose inner and outer
      orders are p, q >= 1 misses the radiance by at most

        (c_outer g^q M_outer D D^(q - 1) + (D sum |w|) G (c_inner M_inner D) D^(p - 1)
         + (D sum |w|) G tau_max^2 D / 2) d.

    Source.  Textbook: the replacement is the usual step from the integral to
    compositing with opacities (Max 1995).  The constants are worked out here.

    Assumptions.  Those of Nested.v; an extinction between 0 and tau_max along the
    ray; inner nodes on [0, 1], inner weights not negative and with sum 1.  At a node
    inside a segment the part in front of it attenuates by a factor of its own.

    LinearExponentialOrder.v shows that the order is not above 1. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Sums Derivatives Quadrature Composite Order Nested.
Import ListNotations.
Open Scope R_scope.

Definition linear_transmittance (q : list R) : R :=
  fold_right (fun q_j product => (1 - q_j) * product) 1 q.

Lemma linear_exponential_one (q : R) : 0 <= q -> 0 <= exp (- q) - (1 - q) <= q ^ 2 / 2.
Proof.
  intros Hq. split.
  - assert (1 + - q <= exp (- q)) by apply exp_ineq1_le. lra.
  - assert (H := nondecreasing (fun x => x ^ 2 / 2 + 1 - x - exp (- x)) (fun x => x - 1 + exp (- x))
      q Hq).
    cbv beta in H. rewrite Ropp_0, exp_0 in H.
    cut (0 ^ 2 / 2 + 1 - 0 - 1 <= q ^ 2 / 2 + 1 - q - exp (- q)); [lra |]. apply H.
    + intros x _. auto_derive; [easy | field].
    + intros x _. assert (1 + - x <= exp (- x)) by apply exp_ineq1_le. lra.
Qed.

Lemma exp_opp_within (x : R) : 0 <= x -> 0 < exp (- x) <= 1.
Proof.
  intros [Hx | <-]; (split; [apply exp_pos |]).
  - left. rewrite <- exp_0. apply exp_increasing. lra.
  - rewrite Ropp_0, exp_0. lra.
Qed.

Lemma linear_exponential_signed (q : list R) :
  (forall q_j, In q_j q -> 0 <= q_j <= 1) ->
  0 <= exp (- sum_over q (fun x => x)) - linear_transmittance q
    <= sum_over q (fun x => x ^ 2) / 2.
Proof.
  induction q as [| q_j q IH]; intros Hq.
  - simpl. rewrite Ropp_0, exp_0. lra.
  - assert (Hj : 0 <= q_j <= 1) by (apply Hq; simpl; auto).
    destruct IH as [low high]; [intros x Hx; apply Hq; simpl; auto |].
    destruct (linear_exponential_one q_j) as [low_j high_j]; [lra |].
    assert (rest_pos : 0 <= sum_over q (fun x => x)).
    { apply sum_over_nonnegative. intros x Hx. apply Hq. simpl. auto. }
    destruct (exp_opp_within _ rest_pos) as [T_pos T_one].
    simpl sum_over. simpl linear_transmittance. rewrite Ropp_plus_distr, exp_plus.
    set (T := exp (- sum_over q (fun x => x))) in *.
    replace (exp (- q_j) * T - (1 - q_j) * linear_transmittance q) with
      ((exp (- q_j) - (1 - q_j)) * T + (1 - q_j) * (T - linear_transmittance q)) by ring.
    split; [nra |].
    assert ((exp (- q_j) - (1 - q_j)) * T <= q_j ^ 2 / 2 * 1)
      by (apply Rmult_le_compat; lra).
    assert ((1 - q_j) * (T - linear_transmittance q) <= 1 * (sum_over q (fun x => x ^ 2) / 2))
      by (apply Rmult_le_compat; lra).
    simpl in *. lra.
Qed.

Theorem linear_exponential_bound (q : list R) :
  (forall q_j, In q_j q -> 0 <= q_j <= 1) ->
  Rabs (linear_transmittance q - exp (- sum_over q (fun x => x)))
    <= sum_over q (fun x => x ^ 2) / 2.
Proof.
  intros Hq. destruct (linear_exponential_signed q Hq). rewrite Rabs_minus_sym, Rabs_pos_eq; lra.
Qed.

(** The depths of the segments up to x into segment j: they add up to [inner_depth]. *)
Definition segment_depths (P : rule) (sigma : R -> R) (d : R) (j : nat) (x : R) : list R :=
  map (fun i => apply_rule P sigma (0 + INR i * d) d) (seq 0 j)
  ++ [apply_rule P sigma (INR j * d) x].

Lemma segment_depths_sum (P : rule) (sigma : R -> R) (d : R) (j : nat) (x : R) :
  sum_over (segment_depths P sigma d j x) (fun q => q) = inner_depth P sigma d j x.
Proof.
  unfold segment_depths, inner_depth, composite. rewrite sum_over_app, sum_over_map. simpl. ring.
Qed.

Lemma lower_to_first (d D : R) (r p : nat) :
  0 < d <= D -> (1 <= r <= p)%nat -> D ^ (p - r) * d ^ r <= D ^ (p - 1) * d.
Proof.
  intros Hd Hr. replace (p - 1)%nat with ((p - r) + (r - 1))%nat by lia.
  assert (H := lower_power d D 1 r Hd (proj1 Hr)). rewrite pow_1 in H.
  rewrite pow_add, Rmult_assoc. apply Rmult_le_compat_l; [apply pow_le; lra | exact H].
Qed.

Section LinearExponential.
Variables field extinction emission : R -> R.
Let sigma := extinction_along field extinction.
Variables (P : rule) (p : nat) (c_inner M_inner : R) (tau : nat -> R -> R).
Variables (g : nat) (O : group_rule) (q : nat) (c_outer M_outer : R) (f : nat -> R -> R).
Variables (D G tau_max : R) (m : nat).
Let d := D / INR (g * m).

(** The nested rule with 1 - q_j for the attenuation of a segment. *)
Definition linear_rule : R :=
  sum_over (ray_nodes O m) (fun i => weight g d i
    * source field extinction emission (position g d i)
    * linear_transmittance (segment_depths P sigma d (segment g i) (offset d i))).

Hypothesis inner_rule : panel_bound P p c_inner.
Hypothesis inner_weights : forall c w, In (c, w) P -> 0 <= c <= 1 /\ 0 <= w.
Hypothesis inner_weights_sum : sum_over P snd = 1.
Hypothesis outer_rule : panel_bound (on_group g O) q c_outer.
Hypothesis outer_nodes : within_group g O.
Hypotheses (some_length : 0 < D) (some_segment : (0 < g * m)%nat).
Hypothesis ray : smooth_ray field extinction emission p q tau f D M_inner M_outer G.
Hypothesis absorbing : forall l, 0 <= l <= D -> 0 <= sigma l <= tau_max.
Hypothesis short_segments : tau_max * d <= 1.

Lemma rule_between (a h : R) :
  0 <= a -> 0 <= h -> a + h <= D -> 0 <= apply_rule P sigma a h <= tau_max * h.
Proof.
  intros Ha Hh HD. unfold apply_rule.
  assert (node : forall c w, In (c, w) P -> 0 <= sigma (a + c * h) <= tau_max).
  { intros c w Hcw. destruct (inner_weights c w Hcw). apply absorbing. split; nra. }
  split.
  - apply Rmult_le_pos; [easy |]. apply sum_over_nonnegative. intros [c w] Hcw.
    apply Rmult_le_pos; [apply (inner_weights c w Hcw) | apply (node c w Hcw)].
  - rewrite (Rmult_comm tau_max). apply Rmult_le_compat_l; [easy |].
    rewrite <- (Rmult_1_r tau_max), <- inner_weights_sum, <- sum_over_scal.
    apply sum_over_le. intros [c w] Hcw. simpl. rewrite Rmult_comm.
    apply Rmult_le_compat_r; [apply (inner_weights c w Hcw) | apply (node c w Hcw)].
Qed.

(** What it costs in the transmittance at a node. *)
Lemma linear_transmittance_error (j : nat) (x : R) :
  0 <= x <= d -> INR j * d + x <= D ->
  Rabs (exp (- inner_depth P sigma d j x)
        - linear_transmittance (segment_depths P sigma d j x))
    <= tau_max ^ 2 * D / 2 * d.
Proof.
  intros Hx HD.
  assert (tau_pos : 0 <= tau_max) by (destruct (absorbing 0); lra).
  assert (j_pos : 0 <= INR j * d) by (apply Rmult_le_pos; [apply pos_INR | lra]).
  assert (part := rule_between (INR j * d) x j_pos (proj1 Hx) HD).
  assert (whole : forall i, In i (seq 0 j) ->
    0 <= apply_rule P sigma (0 + INR i * d) d <= tau_max * d).
  { intros i Hi. apply in_seq in Hi. assert (0 <= INR i) by apply pos_INR.
    assert (INR i + 1 <= INR j) by (rewrite <- S_INR; apply le_INR; lia).
    assert ((INR i + 1) * d <= INR j * d) by (apply Rmult_le_compat_r; lra).
    apply rule_between; [| lra | lra]. rewrite Rplus_0_l. apply Rmult_le_pos; lra. }
  assert (tau_max * x <= tau_max * d) by (apply Rmult_le_compat_l; lra).
  rewrite <- segment_depths_sum, Rabs_minus_sym.
  eapply Rle_trans; [apply linear_exponential_bound |].
  - intros q_j Hq. unfold segment_depths in Hq. apply in_app_iff in Hq as [Hq | [<- | []]]; [| lra].
    apply in_map_iff in Hq as [i [<- Hi]]. specialize (whole i Hi). lra.
  - unfold segment_depths. rewrite sum_over_app, sum_over_map.
    assert (whole_squares : sum_over (seq 0 j) (fun i => apply_rule P sigma (0 + INR i * d) d ^ 2)
      <= INR j * (tau_max * d) ^ 2).
    { rewrite <- sum_over_seq_constant. apply sum_over_le. intros i Hi. now apply pow_incr, whole. }
    assert (part_square : apply_rule P sigma (INR j * d) x ^ 2 <= tau_max ^ 2 * d * x).
    { replace (tau_max ^ 2 * d * x) with ((tau_max * d) * (tau_max * x)) by ring.
      rewrite <- Rsqr_pow2. apply Rmult_le_compat; lra. }
    assert (total : tau_max ^ 2 * d * (INR j * d + x) <= tau_max ^ 2 * d * D).
    { apply Rmult_le_compat_l; [apply Rmult_le_pos; [apply pow2_ge_0 | lra] | easy]. }
    simpl sum_over at 2. lra.
Qed.

Theorem linear_exponential_first_order :
  Rabs (radiance field extinction emission D - linear_rule)
    <= (c_outer * INR g ^ q * M_outer * D * D ^ (q - 1)
        + D * total_weight O * G * (c_inner * M_inner * D) * D ^ (p - 1)
        + D * total_weight O * G * (tau_max ^ 2 * D / 2)) * d.
Proof.
  assert (Hd : 0 < d <= D) by now apply segment_length.
  assert (HD : INR (g * m) * d = D) by (unfold d; field; apply not_0_INR; lia).
  assert (bounds : 0 <= G /\ 0 <= M_inner /\ 0 <= M_outer).
  { destruct ray as [_ _ extinction_bound _ _ integrand_bound source_bound].
    repeat split; (eapply Rle_trans; [apply Rabs_pos |]);
      [apply (source_bound 0) | apply (extinction_bound 0) | apply (integrand_bound 0)]; lra. }
  assert (tau_pos : 0 <= tau_max) by (destruct (absorbing 0); lra).
  assert (inside : forall i, In i (ray_nodes O m) ->
    0 <= offset d i <= d /\ 0 <= position g d i <= D).
  { intros i Hi. assert (H := position_within g O d m i outer_nodes ltac:(lra) Hi).
    rewrite HD in H. unfold position in *. lra. }
  assert (linear : Rabs (nested_rule field extinction emission P g O d m - linear_rule)
    <= D * total_weight O * G * (tau_max ^ 2 * D / 2 * d)).
  { apply transmittance_error_propagates; [easy | | | |].
    - apply Rmult_le_pos; [apply Rdiv_le_0_compat |]; try lra.
      apply Rmult_le_pos; [apply pow2_ge_0 | lra].
    - intros i Hi. apply ray, inside, Hi.
    - intros i Hi. destruct (inside i Hi). now apply linear_transmittance_error.
    - rewrite total_weight_of_ray, HD by lra. apply Rle_refl. }
  assert (nested := nested_bound_absorbing field extinction emission P p c_inner M_inner tau
    g O q c_outer M_outer f D G m inner_rule outer_rule outer_nodes some_length some_segment ray
    (fun l Hl => proj1 (absorbing l Hl)) inner_weights).
  cbv zeta in nested. fold d in nested.
  destruct inner_rule as [Hp _], outer_rule as [Hq _].
  assert (c_pos := panel_bound_nonnegative _ _ _ inner_rule).
  assert (c'_pos := panel_bound_nonnegative _ _ _ outer_rule).
  assert (W_pos : 0 <= total_weight O).
  { apply sum_over_nonnegative. intros [[s o] w] _. apply Rabs_pos. }
  assert (g_pos : 0 <= INR g ^ q) by apply pow_le, pos_INR.
  assert (inner_part := Rmult_le_compat_l (D * total_weight O * G * (c_inner * M_inner * D)) _ _
    ltac:(repeat apply Rmult_le_pos; lra) (lower_to_first d D (Nat.min p q) p Hd ltac:(lia))).
  assert (outer_part := Rmult_le_compat_l (c_outer * INR g ^ q * M_outer * D) _ _
    ltac:(repeat apply Rmult_le_pos; lra) (lower_to_first d D (Nat.min p q) q Hd ltac:(lia))).
  replace (_ - linear_rule) with
    ((radiance field extinction emission D - nested_rule field extinction emission P g O d m)
     + (nested_rule field extinction emission P g O d m - linear_rule)) by ring.
  eapply Rle_trans; [apply Rabs_triang | lra].
Qed.
End LinearExponential.
