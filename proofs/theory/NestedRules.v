(** * Riemann, trapezoid and Simpson sums of the volume rendering integral

    Claim.  With n segments of length d = D/n, in a medium that only absorbs, the
    radiance is missed by at most

      Riemann, left, inside and outside   (M_outer D / 2 + G M_inner D^2 / 2) d
      trapezoid, inside and outside       (M_outer D / 12 + G M_inner D^2 / 12) d^2
      Simpson, inside and outside         (M_outer D / 180 + G M_inner D^2 / 2880) d^4

    where M_inner bounds the derivative of the extinction and M_outer that of the
    integrand that belong to the rule's order, 1, 2 and 4, and G the source.

    Source.  Nested.v (equation 22 of the paper) with the constants of Quadrature.v.

    Assumptions.  Those of Nested.v, and an extinction of at least 0.  The inner
    Simpson rule is used on each segment with the segment's midpoint, the outer one
    on pairs of segments, so that n is even.

    These three rules are the program's classical ones; what it measures has to
    approach the powers of d proved here. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Sums Derivatives Quadrature Composite Order Nested.
Import ListNotations.
Open Scope R_scope.

Definition riemann_segment : group_rule := [(0%nat, 0, 1)].
Definition trapezoid_segment : group_rule := [(0%nat, 0, 1/2); (0%nat, 1, 1/2)].
Definition simpson_pair : group_rule := [(0%nat, 0, 1/6); (1%nat, 0, 2/3); (1%nat, 1, 1/6)].

(** What is to be checked of each node of a rule that is written out. *)
Ltac each_node :=
  intros c w Hcw; simpl in Hcw; repeat destruct Hcw as [[= <- <-] | Hcw]; [lra .. | easy].
Ltac each_group_node :=
  intros s o w Hs; simpl in Hs; repeat destruct Hs as [[= <- <- <-] | Hs];
  [split; (lia || lra) .. | easy].

Section Rules.
Variables field extinction emission : R -> R.
Variables (tau f : nat -> R -> R) (D M_inner M_outer G : R).
Hypothesis some_length : 0 < D.
Hypothesis absorbing : forall l, 0 <= l <= D -> 0 <= extinction_along field extinction l.
Let exact := radiance field extinction emission D.
Let approximation := nested_rule field extinction emission.

Theorem nested_riemann_first_order (n : nat) :
  let d := D / INR n in
  (0 < n)%nat -> smooth_ray field extinction emission 1 1 tau f D M_inner M_outer G ->
  Rabs (exact - approximation riemann_left 1 riemann_segment d n)
    <= (M_outer * D / 2 + G * M_inner * D ^ 2 / 2) * d.
Proof.
  intros d Hn ray.
  assert (outer : panel_bound (on_group 1 riemann_segment) 1 (1 / 2)).
  { replace (on_group 1 riemann_segment) with riemann_left; [apply riemann_left_panel |].
    unfold on_group, riemann_segment, riemann_left. simpl. repeat f_equal; field. }
  assert (bound := nested_bound_absorbing field extinction emission riemann_left 1 (1 / 2) M_inner
    tau 1 riemann_segment 1 (1 / 2) M_outer f D G n riemann_left_panel outer).
  cbv zeta in bound. rewrite Nat.mul_1_l in bound. fold d in bound.
  eapply Rle_trans; [apply bound | apply Req_le]; try easy; try lia.
  - each_group_node.
  - each_node.
  - unfold total_weight. simpl. rewrite !Rabs_pos_eq by lra. field.
Qed.

Theorem nested_trapezoid_second_order (n : nat) :
  let d := D / INR n in
  (0 < n)%nat -> smooth_ray field extinction emission 2 2 tau f D M_inner M_outer G ->
  Rabs (exact - approximation trapezoid 1 trapezoid_segment d n)
    <= (M_outer * D / 12 + G * M_inner * D ^ 2 / 12) * d ^ 2.
Proof.
  intros d Hn ray.
  assert (outer : panel_bound (on_group 1 trapezoid_segment) 2 (1 / 12)).
  { replace (on_group 1 trapezoid_segment) with trapezoid; [apply trapezoid_panel |].
    unfold on_group, trapezoid_segment, trapezoid. simpl. repeat f_equal; field. }
  assert (bound := nested_bound_absorbing field extinction emission trapezoid 2 (1 / 12) M_inner
    tau 1 trapezoid_segment 2 (1 / 12) M_outer f D G n trapezoid_panel outer).
  cbv zeta in bound. rewrite Nat.mul_1_l in bound. fold d in bound.
  eapply Rle_trans; [apply bound | apply Req_le]; try easy; try lia.
  - each_group_node.
  - each_node.
  - unfold total_weight. simpl. rewrite !Rabs_pos_eq by lra. field.
Qed.

(** On m pairs of segments. *)
Theorem nested_simpson_fourth_order (m : nat) :
  let d := D / INR (2 * m) in
  (0 < m)%nat -> smooth_ray field extinction emission 4 4 tau f D M_inner M_outer G ->
  Rabs (exact - approximation simpson 2 simpson_pair d m)
    <= (M_outer * D / 180 + G * M_inner * D ^ 2 / 2880) * d ^ 4.
Proof.
  intros d Hm ray.
  assert (outer : panel_bound (on_group 2 simpson_pair) 4 (1 / 2880)).
  { replace (on_group 2 simpson_pair) with simpson; [apply simpson_panel |].
    unfold on_group, simpson_pair, simpson. simpl. repeat f_equal; field. }
  assert (bound := nested_bound_absorbing field extinction emission simpson 4 (1 / 2880) M_inner
    tau 2 simpson_pair 4 (1 / 2880) M_outer f D G m simpson_panel outer).
  cbv zeta in bound. fold d in bound.
  eapply Rle_trans; [apply bound | apply Req_le]; try easy; try lia.
  - each_group_node.
  - each_node.
  - unfold total_weight. simpl. rewrite !Rabs_pos_eq by lra. field.
Qed.
End Rules.
