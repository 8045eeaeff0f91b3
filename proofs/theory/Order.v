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

    Assumptions.  Those just named, 0 < d <= D, and an exact exponential.  Weights
    may be negative, G and K_inner may not (the rule may lack nodes).  Nothing is
    assumed about where the nodes lie or about smoothness: that p and q hold is for
    the rules and the case to answer, and Nested.v draws it from Quadrature.v.

    Not claimed.  This bounds the error from above.  A nested rule may do better,
    as with a constant extinction, for which every inner rule is exact. *)

From Coq Require Import Reals Lra Lia List.
From Volver Require Import Integral Sums.
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

Lemma segment_length (D : R) (n : nat) : 0 < D -> (0 < n)%nat -> 0 < D / INR n <= D.
Proof.
  intros HD Hn. assert (1 <= INR n) by (apply (le_INR 1); lia).
  split; [apply Rdiv_lt_0_compat; lra |].
  apply Rmult_le_reg_r with (INR n); [lra |].
  replace (D / INR n * INR n) with D by (field; lra).
  rewrite <- (Rmult_1_r D) at 1. apply Rmult_le_compat_l; lra.
Qed.

Section Nested.
Variables field extinction emission : R -> R.
Variable D : R.

(** Whatever numbers the nodes of the outer rule. *)
Context {index : Type}.

(** An outer rule with a list of nodes, fed with optical depths from somewhere. *)
Definition nested (nodes : list index) (weight node depth : index -> R) : R :=
  sum_over nodes (fun i => weight i * source field extinction emission (node i) * exp (- depth i)).

Definition depth_at (node : index -> R) (i : index) : R :=
  optical_depth field extinction (node i).

(** What an error [e] in the transmittances does to the outer rule. *)
Lemma transmittance_error_propagates (nodes : list index) (weight node T T' : index -> R)
    (W G e : R) :
  0 <= G -> 0 <= e ->
  (forall i, In i nodes -> Rabs (source field extinction emission (node i)) <= G) ->
  (forall i, In i nodes -> Rabs (T i - T' i) <= e) ->
  sum_over nodes (fun i => Rabs (weight i)) <= W ->
  Rabs (sum_over nodes (fun i => weight i * source field extinction emission (node i) * T i)
        - sum_over nodes (fun i => weight i * source field extinction emission (node i) * T' i))
    <= W * G * e.
Proof.
  intros G_pos e_pos HG He HW. rewrite sum_over_minus.
  eapply Rle_trans; [apply sum_over_abs |].
  apply Rle_trans with (sum_over nodes (fun i => G * e * Rabs (weight i))).
  - apply sum_over_le. intros i Hi.
    rewrite <- Rmult_minus_distr_l, !Rabs_mult, Rmult_assoc, (Rmult_comm _ (Rabs (weight i))).
    apply Rmult_le_compat_l; [apply Rabs_pos |].
    apply Rmult_le_compat; try apply Rabs_pos; auto.
  - rewrite sum_over_scal. replace (W * G * e) with (G * e * W) by ring.
    apply Rmult_le_compat_l; [now apply Rmult_le_pos | exact HW].
Qed.

(** Equation 22 at one step d, with its constant. *)
Theorem min_order_bound (nodes : list index) (p q : nat) (weight node depth : index -> R)
    (d K_inner K_outer L W G : R) :
  let exact := radiance field extinction emission D in
  let r := Nat.min p q in
  0 < d <= D -> 0 <= K_inner -> 0 <= G ->
  (forall i, In i nodes -> - L <= depth_at node i) ->
  (forall i, In i nodes -> - L <= depth i) ->
  (forall i, In i nodes -> Rabs (source field extinction emission (node i)) <= G) ->
  sum_over nodes (fun i => Rabs (weight i)) <= W ->
  (forall i, In i nodes -> Rabs (depth i - depth_at node i) <= K_inner * d ^ p) ->
  Rabs (exact - nested nodes weight node (depth_at node)) <= K_outer * d ^ q ->
  Rabs (exact - nested nodes weight node depth)
    <= (K_outer * D ^ (q - r) + exp L * W * G * K_inner * D ^ (p - r)) * d ^ r.
Proof.
  intros exact r Hd K_inner_pos G_pos Ht Hdepth HG HW Hinner Houter.
  assert (power_pos : forall k, 0 < d ^ k) by (intros k; apply pow_lt; lra).
  assert (L_pos : 0 < exp L) by apply exp_pos.
  assert (W_pos : 0 <= W).
  { eapply Rle_trans; [| exact HW]. apply sum_over_nonnegative. intros i _. apply Rabs_pos. }
  assert (K_outer_pos : 0 <= K_outer).
  { apply Rmult_le_reg_r with (d ^ q); [apply power_pos |].
    rewrite Rmult_0_l. eapply Rle_trans; [apply Rabs_pos | exact Houter]. }
  assert (e_pos : 0 <= exp L * (K_inner * d ^ p)).
  { assert (0 < d ^ p) by apply power_pos. repeat apply Rmult_le_pos; lra. }
  assert (inner := transmittance_error_propagates nodes weight node
    (fun i => exp (- depth_at node i)) (fun i => exp (- depth i)) W G
    (exp L * (K_inner * d ^ p)) G_pos e_pos HG).
  fold (nested nodes weight node (depth_at node)) (nested nodes weight node depth) in inner.
  assert (constant_pos : 0 <= exp L * W * G * K_inner) by (repeat apply Rmult_le_pos; lra).
  assert (Hp := lower_power d D r p Hd (Nat.le_min_l p q)).
  assert (Hq := lower_power d D r q Hd (Nat.le_min_r p q)).
  apply (Rmult_le_compat_l _ _ _ constant_pos) in Hp.
  apply (Rmult_le_compat_l _ _ _ K_outer_pos) in Hq.
  replace (exact - nested nodes weight node depth)
    with ((exact - nested nodes weight node (depth_at node))
          + (nested nodes weight node (depth_at node) - nested nodes weight node depth)) by ring.
  eapply Rle_trans; [apply Rabs_triang |].
  apply Rle_trans with (K_outer * d ^ q + W * G * (exp L * (K_inner * d ^ p))); [| lra].
  apply Rplus_le_compat; [exact Houter | apply inner; [| exact HW]]. intros i Hi.
  eapply Rle_trans; [apply transmittance_lipschitz; auto |].
  rewrite Rabs_minus_sym. apply Rmult_le_compat_l; [lra | auto].
Qed.

(** Equation 22 as the paper reads it: rules for n = 1, 2, ... segments. *)
Theorem min_order (nodes : nat -> list index) (p q : nat) (weight node depth : nat -> index -> R)
    (K_inner L W G : R) :
  let exact := radiance field extinction emission D in
  0 < D -> 0 <= K_inner -> 0 <= G ->
  (forall n i, (0 < n)%nat -> In i (nodes n) -> - L <= depth_at (node n) i) ->
  (forall n i, (0 < n)%nat -> In i (nodes n) -> - L <= depth n i) ->
  (forall n i, (0 < n)%nat -> In i (nodes n) ->
     Rabs (source field extinction emission (node n i)) <= G) ->
  (forall n, (0 < n)%nat -> sum_over (nodes n) (fun i => Rabs (weight n i)) <= W) ->
  (forall n i, (0 < n)%nat -> In i (nodes n) ->
     Rabs (depth n i - depth_at (node n) i) <= K_inner * (D / INR n) ^ p) ->
  has_order q D exact (fun n => nested (nodes n) (weight n) (node n) (depth_at (node n))) ->
  has_order (Nat.min p q) D exact (fun n => nested (nodes n) (weight n) (node n) (depth n)).
Proof.
  intros exact HD K_inner_pos G_pos Ht Hdepth HG HW Hinner [K_outer Houter].
  exists (K_outer * D ^ (q - Nat.min p q) + exp L * W * G * K_inner * D ^ (p - Nat.min p q)).
  intros n Hn. apply min_order_bound; auto using segment_length.
Qed.
End Nested.
