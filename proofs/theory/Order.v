(** * The order of nested quadrature is at least min(p, q)

    Claim.  Let the inner rule give the optical depth at the nodes of the outer
    rule with an error of at most K_inner d^p, and let the outer rule, fed with
    exact depths, give the radiance with an error of at most K_outer d^q.  Then
    the nested rule

      sum_i w_i C_i tau_i exp(- depth_i)

    misses the radiance by at most

      (K_outer D^(q - r) + e^L W G K_inner D^(p - r)) d^r,    r = min(p, q),

    where W bounds sum |w_i| (it is D if the weights are positive), G bounds
    |C tau| at the nodes, and no depth, exact or approximate, is below -L (L = 0
    for a medium that only absorbs and an inner rule with positive weights).

    Source.  Etiene, Kirby and Silva, "A Study Of Discretization Errors In Volume
    Rendering Integral Approximations", equation 22 with equation 3 (the inner
    rule) and 16 (the outer rule); their constants stay inside O().

    Assumptions.  Those just named, 0 < d <= D, and an exact exponential.  Nothing
    is assumed about where the nodes lie or about smoothness: that p and q hold is
    for the rules and the case to answer.

    Not claimed.  This bounds the error from above.  A nested rule may do better,
    as with a constant extinction, for which every inner rule is exact. *)

From Coq Require Import Reals Lra Lia.
From Volver Require Import Integral.
Open Scope R_scope.

(** An upper bound of the error over all n, at d = D/n. *)
Definition has_order (r : nat) (D exact : R) (approximation : nat -> R) : Prop :=
  exists K, forall n, (0 < n)%nat -> Rabs (exact - approximation n) <= K * (D / INR n) ^ r.

Lemma exp_opp_difference (L a b : R) :
  - L <= a <= b -> 0 <= exp (- a) - exp (- b) <= exp L * (b - a).
Proof.
  intros Hab.
  assert (product : exp (- b) = exp (- a) * exp (a - b)) by (rewrite <- exp_plus; f_equal; ring).
  assert (monotone : forall x y, x <= y -> exp x <= exp y).
  { intros x y [Hxy | ->]; [left; now apply exp_increasing | apply Rle_refl]. }
  assert (exp (- a) <= exp L) by (apply monotone; lra).
  assert (exp (a - b) <= 1) by (rewrite <- exp_0; apply monotone; lra).
  assert (1 + (a - b) <= exp (a - b)) by apply exp_ineq1_le.
  assert (0 < exp (- a)) by apply exp_pos.
  rewrite product. replace (exp (- a) - exp (- a) * exp (a - b))
    with (exp (- a) * (1 - exp (a - b))) by ring.
  split; [apply Rmult_le_pos | apply Rmult_le_compat]; lra.
Qed.

(** The transmittance is a Lipschitz function of the optical depth. *)
Lemma transmittance_lipschitz (L a b : R) :
  - L <= a -> - L <= b -> Rabs (exp (- a) - exp (- b)) <= exp L * Rabs (a - b).
Proof.
  intros Ha Hb. destruct (Rle_dec a b) as [Hab | Hab].
  - destruct (exp_opp_difference L a b) as [H0 H1]; [lra |].
    rewrite Rabs_pos_eq, Rabs_minus_sym, Rabs_pos_eq; lra.
  - destruct (exp_opp_difference L b a) as [H0 H1]; [lra |].
    rewrite Rabs_minus_sym, Rabs_pos_eq, Rabs_pos_eq; lra.
Qed.

(** A step's power may be lowered at the price of a power of the ray's length. *)
Lemma lower_power (d D : R) (r p : nat) :
  0 < d <= D -> (r <= p)%nat -> d ^ p <= D ^ (p - r) * d ^ r.
Proof.
  intros Hd Hr. replace p with ((p - r) + r)%nat at 1 by lia. rewrite pow_add.
  apply Rmult_le_compat_r; [apply pow_le; lra | apply pow_incr; lra].
Qed.

Section Nested.
Variables field extinction emission : R -> R.
Variable D : R.

(** An outer rule with nodes 0, ..., N, fed with optical depths from somewhere. *)
Definition nested (N : nat) (weight node depth : nat -> R) : R :=
  sum_f_R0 (fun i => weight i * source field extinction emission (node i) * exp (- depth i)) N.

Definition depth_at (node : nat -> R) (i : nat) : R := optical_depth field extinction (node i).

(** What an error [e] in the depths does to the outer rule. *)
Lemma depth_error_propagates (N : nat) (weight node t depth : nat -> R) (L W G e : R) :
  (forall i, (i <= N)%nat -> - L <= t i) ->
  (forall i, (i <= N)%nat -> - L <= depth i) ->
  (forall i, (i <= N)%nat -> Rabs (source field extinction emission (node i)) <= G) ->
  (forall i, (i <= N)%nat -> Rabs (depth i - t i) <= e) ->
  sum_f_R0 (fun i => Rabs (weight i)) N <= W ->
  Rabs (nested N weight node t - nested N weight node depth) <= exp L * W * G * e.
Proof.
  intros Ht Hdepth HG He HW. unfold nested. rewrite <- minus_sum.
  eapply Rle_trans; [apply Rsum_abs |].
  assert (G_pos : 0 <= G) by (eapply Rle_trans; [apply Rabs_pos | apply (HG 0%nat); lia]).
  assert (e_pos : 0 <= e) by (eapply Rle_trans; [apply Rabs_pos | apply (He 0%nat); lia]).
  assert (L_pos : 0 < exp L) by apply exp_pos.
  apply Rle_trans with (sum_f_R0 (fun i => Rabs (weight i) * (G * (exp L * e))) N).
  - apply sum_Rle. intros i Hi.
    rewrite <- Rmult_minus_distr_l, !Rabs_mult, Rmult_assoc.
    apply Rmult_le_compat_l; [apply Rabs_pos |].
    apply Rmult_le_compat; try apply Rabs_pos; auto.
    eapply Rle_trans; [apply transmittance_lipschitz; auto |].
    rewrite Rabs_minus_sym. apply Rmult_le_compat_l; [lra | auto].
  - rewrite <- scal_sum. replace (exp L * W * G * e) with (G * (exp L * e) * W) by ring.
    apply Rmult_le_compat_l; [repeat apply Rmult_le_pos; lra | exact HW].
Qed.

(** Equation 22 at one step d, with its constant. *)
Theorem min_order_bound (N p q : nat) (weight node depth : nat -> R)
    (d K_inner K_outer L W G : R) :
  let exact := radiance field extinction emission D in
  let r := Nat.min p q in
  0 < d <= D ->
  (forall i, (i <= N)%nat -> - L <= depth_at node i) ->
  (forall i, (i <= N)%nat -> - L <= depth i) ->
  (forall i, (i <= N)%nat -> Rabs (source field extinction emission (node i)) <= G) ->
  sum_f_R0 (fun i => Rabs (weight i)) N <= W ->
  (forall i, (i <= N)%nat -> Rabs (depth i - depth_at node i) <= K_inner * d ^ p) ->
  Rabs (exact - nested N weight node (depth_at node)) <= K_outer * d ^ q ->
  Rabs (exact - nested N weight node depth)
    <= (K_outer * D ^ (q - r) + exp L * W * G * K_inner * D ^ (p - r)) * d ^ r.
Proof.
  intros exact r Hd Ht Hdepth HG HW Hinner Houter.
  assert (inner := depth_error_propagates N weight node (depth_at node) depth L W G
    (K_inner * d ^ p) Ht Hdepth HG Hinner HW).
  assert (nonnegative : forall K k x, Rabs x <= K * d ^ k -> 0 <= K).
  { intros K k x Hx. apply Rmult_le_reg_r with (d ^ k); [apply pow_lt; lra |].
    rewrite Rmult_0_l. eapply Rle_trans; [apply Rabs_pos | exact Hx]. }
  assert (K_outer_pos := nonnegative _ _ _ Houter).
  assert (constant_pos : 0 <= exp L * W * G * K_inner).
  { apply nonnegative with p (nested N weight node (depth_at node) - nested N weight node depth).
    now rewrite Rmult_assoc. }
  assert (Hp := lower_power d D r p Hd (Nat.le_min_l p q)).
  assert (Hq := lower_power d D r q Hd (Nat.le_min_r p q)).
  apply (Rmult_le_compat_l _ _ _ constant_pos) in Hp.
  apply (Rmult_le_compat_l _ _ _ K_outer_pos) in Hq.
  replace (exact - nested N weight node depth)
    with ((exact - nested N weight node (depth_at node))
          + (nested N weight node (depth_at node) - nested N weight node depth)) by ring.
  eapply Rle_trans; [apply Rabs_triang |]. lra.
Qed.

(** Equation 22 as the paper reads it: rules for n = 1, 2, ... segments. *)
Theorem min_order (N : nat -> nat) (p q : nat) (weight node depth : nat -> nat -> R)
    (K_inner L W G : R) :
  let exact := radiance field extinction emission D in
  0 < D ->
  (forall n i, (0 < n)%nat -> (i <= N n)%nat -> - L <= depth_at (node n) i) ->
  (forall n i, (0 < n)%nat -> (i <= N n)%nat -> - L <= depth n i) ->
  (forall n i, (0 < n)%nat -> (i <= N n)%nat ->
     Rabs (source field extinction emission (node n i)) <= G) ->
  (forall n, (0 < n)%nat -> sum_f_R0 (fun i => Rabs (weight n i)) (N n) <= W) ->
  (forall n i, (0 < n)%nat -> (i <= N n)%nat ->
     Rabs (depth n i - depth_at (node n) i) <= K_inner * (D / INR n) ^ p) ->
  has_order q D exact (fun n => nested (N n) (weight n) (node n) (depth_at (node n))) ->
  has_order (Nat.min p q) D exact (fun n => nested (N n) (weight n) (node n) (depth n)).
Proof.
  intros exact HD Ht Hdepth HG HW Hinner [K_outer Houter].
  exists (K_outer * D ^ (q - Nat.min p q) + exp L * W * G * K_inner * D ^ (p - Nat.min p q)).
  intros n Hn. apply min_order_bound; auto.
  assert (1 <= INR n) by (apply (le_INR 1); lia).
  split; [apply Rdiv_lt_0_compat; lra |].
  apply Rmult_le_reg_r with (INR n); [lra |].
  replace (D / INR n * INR n) with D by (field; lra).
  rewrite <- (Rmult_1_r D) at 1. apply Rmult_le_compat_l; lra.
Qed.
End Nested.
